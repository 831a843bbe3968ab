#include "client/cli/program_correction.h"

#include <algorithm>
#include <functional>

#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {
namespace {

using Targets = std::vector<std::vector<double>>;
using Answer = std::function<absl::StatusOr<v1::CompensateResponse>(const v1::CompensateRequest&)>;

constexpr size_t kMostTargetsOfACall = 10000;  // CompensateRequest.targets

v1::CompensateRequest RequestFor(const Targets& targets, size_t begin, size_t end) {
  v1::CompensateRequest request;
  for (size_t i = begin; i < end; ++i) {
    v1::CompensationTarget* target = request.add_targets();
    target->set_row(static_cast<int>(i - begin));
    target->mutable_joints()->Add(targets[i].begin(), targets[i].end());
  }
  return request;
}

programs::CorrectedJoints JointsOf(const v1::CompensatedTarget& target) {
  if (!target.fault().empty()) return {{}, target.fault()};
  return {{target.joints().begin(), target.joints().end()}, ""};
}

absl::StatusOr<std::vector<programs::CorrectedJoints>> CorrectAll(const Targets& targets,
                                                                  const Answer& answer) {
  std::vector<programs::CorrectedJoints> corrected;
  for (size_t begin = 0; begin < targets.size(); begin += kMostTargetsOfACall) {
    const size_t end = std::min(begin + kMostTargetsOfACall, targets.size());
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensateResponse response,
                              answer(RequestFor(targets, begin, end)));
    for (const v1::CompensatedTarget& target : response.targets())
      corrected.push_back(JointsOf(target));
  }
  return corrected;
}

absl::StatusOr<ProgramCorrection> CorrectionOf(const v1::Nominal& nominal,
                                               const std::string& digest, Answer answer) {
  if (nominal.kind() == v1::MEASURING) {
    return FaultStatus("--robot", "a measuring robot",
                       "a robot that runs programs: a measuring robot is read, not commanded");
  }
  ProgramCorrection correction;
  correction.calibration = digest.empty() ? "none" : digest;
  for (const v1::Joint& joint : nominal.joints())
    correction.prismatic.push_back(joint.type() == v1::PRISMATIC);
  correction.correct = [answer = std::move(answer)](const Targets& targets) {
    return CorrectAll(targets, answer);
  };
  return correction;
}

}  // namespace

absl::StatusOr<ProgramCorrection> LocalCorrection(const v1::Nominal& nominal,
                                                  const v1::Calibration& calibration) {
  return CorrectionOf(nominal, calibration.digest(), [&](const v1::CompensateRequest& request) {
    return convert::RunCompensation(nominal, calibration, request);
  });
}

absl::StatusOr<ProgramCorrection> RemoteCorrection(const client::Client& client,
                                                   const v1::Nominal& nominal,
                                                   const v1::Calibration& calibration) {
  const std::string name = calibration.name();
  return CorrectionOf(nominal, calibration.digest(),
                      [&client, name](v1::CompensateRequest request) {
                        request.set_calibration(name);
                        return client.Compensate(request);
                      });
}

}  // namespace truepose::cli
