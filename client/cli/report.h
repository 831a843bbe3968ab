// What a calibration found, for people: mm and degrees, aligned tables, a verdict and why.
#pragma once

#include <string>

#include "client/cli/console.h"
#include "google/protobuf/timestamp.pb.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

// Rows, mean, sd, rms and max of position and rotation, before and after, of each set that is
// there.
std::string SetsTable(const v1::Sets& sets);
std::string SetTable(const std::string& title, const v1::SetReport& set);

// Nominal, identified, change and standard deviation of every identified parameter.
// @param from_earlier the values before are those of an earlier calibration.
std::string ParametersTable(const v1::ParameterReport& parameters, bool from_earlier = false);

// What each dropped parameter acts as ("+1 dq2"), and whether at any poses. "" without any.
std::string RedundanciesText(const v1::CalibrationReport& report);

// Positions and orientations of base and tool, with the rows on which each was fitted.
std::string FramesTable(const v1::CalibrationReport& report);

// Of the control rows when there are some, else of all rows.
std::string ResidualHistogram(const v1::Calibration& calibration, bool utf8);

// "Verdict: apply", coloured, and the reasons below.
std::string VerdictText(const v1::CalibrationReport& report, const Console& console);

// All of the above, without a next step.
std::string CalibrationText(const v1::Calibration& calibration, const Console& console);

// "2025-03-01 12:00:05Z"; "" when absent.
std::string TimeText(const google::protobuf::Timestamp& time);

}  // namespace truepose::cli
