// Which frames of a check are those of a calibration; the rules stand in drift.h.
#pragma once

#include <string>
#include <vector>

#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::convert {

// The calibration's frame of each placement and target of the check; nullptr = not to be held.
struct HeldFrames {
  std::vector<const v1::FrameEstimate*> bases, tools;
};

// @param placements, targets labels of the check's problem. Pointers are into `calibration`.
HeldFrames HeldFramesOf(const v1::Calibration& calibration,
                        const std::vector<v1::Session>& sessions, const v1::SessionInput& check,
                        const std::vector<std::string>& placements,
                        const std::vector<std::string>& targets);

// Names of a frame's six parameters in CalibrationReport.parameters.
std::vector<std::string> ParameterNamesOf(const v1::FrameEstimate& frame,
                                          const v1::CalibrationReport& report);

}  // namespace truepose::convert
