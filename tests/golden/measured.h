// Calibrations of the measured robots, from the files on: formats, conversion, split, start values,
// weights, identification.
#pragma once

#include <string>
#include <vector>

#include "truepose/v1/calibration.pb.h"

namespace truepose::testing {

// A robot of deploy/examples and a session of the shared data; files are read once a process.
v1::CalibrationInput MeasuredInput(const std::string& robot, const std::string& session);

inline v1::CalibrationInput Ur10Series(const std::string& letter) {
  return MeasuredInput("ur10.yaml", "ipa_ur10/series_" + letter + ".csv");
}

// Fails the test and returns an empty one when there is no calibration.
v1::Calibration MustCalibrate(const v1::CalibrationInput& input);

// RMS position of the control set after calibration, mm.
double ControlRms(const v1::Calibration& calibration);

// The verdict with its reasons, for messages.
std::string VerdictOf(const v1::Calibration& calibration);

// "random:SEED:FRACTION" with exactly `calibrate` of `rows` calibration rows.
std::string RandomSplit(int seed, int calibrate, int rows);

// @param values at least one.
double MedianOf(std::vector<double> values);

}  // namespace truepose::testing
