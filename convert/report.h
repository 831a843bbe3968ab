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

// FrameEstimate.fitted_on of a frame that the calibration's own rows determined.
inline constexpr char kOnCalibrationRows[] = "calibration rows";

// The identified parameters with nominal values and deviations, for people. Takes the result's
// model, candidates, change, before, and of the identification estimate, set and covariance.
v1::ParameterReport ParametersOf(const CalibrationResult& result, const Pose& X_FT_nominal);

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

// In a report on a partial recalibration: `nominal` of base and tool becomes what the earlier
// calibration had for the frame of that name. Frames that it did not have stay as they are: fitted
// to these readings with the earlier parameters.
void ShowEarlierFrames(const v1::PriorCalibration& earlier, v1::CalibrationReport* report);

// Internal parameters of the model and the covariance of the identified ones, SI.
void FillParameters(const CalibrationResult& result, v1::Calibration* calibration);

}  // namespace truepose::convert
