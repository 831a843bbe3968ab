#include "convert/held_frames.h"

#include <algorithm>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/measurement/frame.h"

namespace truepose::convert {
namespace {

// Frames that calibration rows fitted have a covariance; the others do not.
bool IsIdentified(const v1::FrameEstimate& frame) {
  return frame.fitted_on() == "calibration rows";
}

const v1::FrameEstimate* Find(const v1::CalibrationReport& report, v1::ParameterGroup group,
                              const std::string& name) {
  for (const v1::FrameEstimate& frame : report.frames())
    if (frame.group() == group && frame.name() == name && IsIdentified(frame)) return &frame;
  return nullptr;
}

bool SharesSetUp(const v1::Calibration& calibration, const v1::Session& a, const v1::Session& b) {
  const bool other_instrument =
      !a.instrument().empty() && !b.instrument().empty() && a.instrument() != b.instrument();
  if (other_instrument) return false;
  if (!a.placement().empty() && a.placement() == b.placement()) return true;
  return !a.fixture().empty() && a.fixture() == b.fixture() && calibration.options().has_fixture();
}

// As readings.cc labels what belongs to one of several sessions.
std::string LabelIn(int session, int sessions, const std::string& label) {
  if (sessions == 1) return label;
  return absl::StrCat("session ", session + 1, label.empty() ? "" : "/", label);
}

// A target that the rows themselves name is one for all sessions.
bool IsNamed(const v1::SessionInput& check, const std::string& label) {
  for (const v1::Reading& row : check.readings()) {
    const std::string& target = row.target();
    if (!target.empty() && (label == target || absl::StartsWith(label, target + "/"))) return true;
  }
  return false;
}

class Matcher {
 public:
  Matcher(const v1::Calibration& calibration, const std::vector<v1::Session>& sessions,
          const v1::SessionInput& check)
      : report_(calibration.report()), count_(std::max(1, calibration.sessions_size())) {
    const int known = std::min(count_, static_cast<int>(sessions.size()));
    for (int i = known - 1; i >= 0; --i)
      if (SharesSetUp(calibration, sessions[static_cast<size_t>(i)], check.session()))
        shared_.push_back(i);
  }

  // Of the last session that shares the set-up and has the frame.
  const v1::FrameEstimate* OfSetUp(v1::ParameterGroup group, const std::string& label) const {
    for (int session : shared_) {
      const auto* frame = Find(report_, group, LabelIn(session, count_, label));
      if (frame != nullptr) return frame;
    }
    return nullptr;
  }

  const v1::FrameEstimate* Named(const std::string& label) const {
    return Find(report_, v1::TOOL, label);
  }

 private:
  const v1::CalibrationReport& report_;
  const int count_;
  std::vector<int> shared_;  // last first
};

}  // namespace

HeldFrames HeldFramesOf(const v1::Calibration& calibration,
                        const std::vector<v1::Session>& sessions, const v1::SessionInput& check,
                        const std::vector<std::string>& placements,
                        const std::vector<std::string>& targets) {
  const Matcher matcher(calibration, sessions, check);
  HeldFrames held;
  for (const std::string& label : placements)
    held.bases.push_back(matcher.OfSetUp(v1::BASE, label));
  for (const std::string& label : targets)
    held.tools.push_back(IsNamed(check, label) ? matcher.Named(label)
                                               : matcher.OfSetUp(v1::TOOL, label));
  return held;
}

std::vector<std::string> ParameterNamesOf(const v1::FrameEstimate& frame,
                                          const v1::CalibrationReport& report) {
  int of_kind = 0;
  for (const v1::FrameEstimate& other : report.frames())
    of_kind += other.group() == frame.group() && IsIdentified(other);
  const ParameterGroup group =
      frame.group() == v1::BASE ? ParameterGroup::kBase : ParameterGroup::kTool;
  std::vector<std::string> names;
  for (int i = 0; i < kFrameParameters; ++i)
    names.push_back(FrameParameter(group, of_kind > 1 ? frame.name() : "", i).name);
  return names;
}

}  // namespace truepose::convert
