// What a report says beside parameters and residuals: counts, choices, suspects, correlations.
#pragma once

#include <string>

#include "truepose/v1/calibration.pb.h"

namespace truepose::cli {

// Sections, each with a blank line before it; empty ones are left out. Suspects stand with the
// session as it was named and the row as sessions and --split count it, from 0.
std::string FindingsText(const v1::Calibration& calibration);

// A job that was only looked at: counts, what the readings determine, and what stays at nominal.
std::string PreviewText(const v1::JobPreview& preview);

// Contact readings against their own places; "" without a fixture.
std::string PlacesText(const v1::CalibrationReport& report);

// Lines on predicted accuracy, the test of a change and the better joints; "" where there are none.
std::string AccuracyText(const v1::CalibrationReport& report);

}  // namespace truepose::cli
