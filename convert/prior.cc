#include <vector>

#include "convert/run.h"

namespace truepose::convert {
namespace {

// Places of the internal parameters beside the covariance.
std::vector<int> InternalPlaces(const v1::CalibrationReport& report) {
  std::vector<int> places;
  for (int i = 0; i < report.parameters().values_size(); ++i)
    if (report.parameters().values(i).group() == v1::INTERNAL) places.push_back(i);
  return places;
}

}  // namespace

v1::PriorCalibration PriorOf(const v1::Calibration& calibration) {
  const v1::CalibrationReport& report = calibration.report();
  v1::PriorCalibration prior;
  prior.set_name(calibration.name());
  prior.set_convention(report.convention());
  *prior.mutable_internal_parameters() = calibration.internal_parameters();
  const std::vector<int> places = InternalPlaces(report);
  const int n = report.parameters().values_size();
  for (int i : places) {
    prior.add_identified(report.parameters().values(i).name());
    for (int j : places) {
      if (calibration.covariance_size() == n * n)
        prior.add_covariance(calibration.covariance(i * n + j));
    }
  }
  prior.set_model_sd_position_mm(report.summary().model_sd_position_mm());
  prior.set_model_sd_rotation_deg(report.summary().model_sd_rotation_deg());
  *prior.mutable_frames() = report.frames();
  return prior;
}

}  // namespace truepose::convert
