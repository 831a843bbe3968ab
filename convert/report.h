// Core results to messages for people (mm, deg) and for machines (SI).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "convert/readings.h"
#include "core/calibrate/calibrate.h"

namespace truepose::convert {

inline constexpr double kMmPerM = 1e3;
inline constexpr double kDegPerRad = 57.295779513082320877;

// Before and after of a set, with the digest of its rows.
v1::SetReport SetReportOf(const SetResult& set, const std::vector<RowOf>& rows);

std::vector<v1::RowResidual> ResidualsOf(const SetResult& complete, const std::vector<RowOf>& rows,
                                         const std::vector<bool>& calibrates);

std::vector<v1::FrameEstimate> FramesOf(const Estimate& estimate,
                                        const std::vector<std::string>& placements,
                                        const std::vector<std::string>& targets,
                                        const std::vector<FittedOn>& base,
                                        const std::vector<FittedOn>& tool);

// Report without warnings, split and joints_used. @param X_FT_nominal nominal values of the tool's
// parameters.
v1::CalibrationReport ReportOf(const CalibrationResult& result, const ReadingsProblem& readings,
                               const std::optional<Pose>& X_FT_nominal);

// Internal parameters of the model and the covariance of the identified ones, SI.
void FillParameters(const CalibrationResult& result, v1::Calibration* calibration);

}  // namespace truepose::convert
