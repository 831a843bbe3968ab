#include "tests/agent/released/released_testing.h"

#include "absl/strings/numbers.h"
#include "convert/run.h"

namespace truepose::agent::testing {
namespace {

absl::StatusOr<jobs::BuiltTable> Build(const v1::CompensationTableInput& input,
                                       const std::array<int, 4>& nodes) {
  const std::string& name = input.calibration().name();
  int number = 0;
  if (!absl::SimpleAtoi(name.substr(name.rfind('/') + 1), &number))
    return absl::InternalError(name);
  auto content = ContentOf(number, nodes);
  content.header.robot = input.robot();
  content.header.serial = input.nominal().serial();
  content.header.calibration = name;
  content.header.calibration_digest = DigestOf(input.calibration().digest());
  content.header.nominal_digest = DigestOf(convert::NominalDigest(input.nominal()));
  jobs::BuiltTable built;
  built.bytes = FileOf(content);
  built.header.set_robot(input.robot());
  built.header.set_calibration(name);
  return built;
}

}  // namespace

jobs::TableBuilder TestTableBuilder(const std::array<int, 4>& nodes) {
  return [nodes](const v1::CompensationTableInput& input, const jobs::RunnerHooks&) {
    return Build(input, nodes);
  };
}

}  // namespace truepose::agent::testing
