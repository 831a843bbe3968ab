#include "convert/accuracy_sources.h"

#include <Eigen/Dense>
#include <vector>

#include "convert/frames.h"
#include "convert/report.h"

namespace truepose::convert {
namespace {

// Places of the internal parameters beside the covariance.
std::vector<int> PlacesOf(const v1::CalibrationReport& report) {
  std::vector<int> places;
  for (int i = 0; i < report.parameters().values_size(); ++i)
    if (report.parameters().values(i).group() == v1::INTERNAL) places.push_back(i);
  return places;
}

// Where what is unexplained was seen: of several targets their middle.
Eigen::Vector3d TargetOf(const v1::CalibrationReport& report) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int tools = 0;
  for (const v1::FrameEstimate& frame : report.frames()) {
    if (frame.group() != v1::TOOL) continue;
    sum += PoseFrom(frame.pose()).p;
    ++tools;
  }
  return tools == 0 ? sum : Eigen::Vector3d(sum / tools);
}

}  // namespace

std::optional<AccuracySources> AccuracySourcesFrom(const CalibratedModel& calibrated,
                                                   const v1::Calibration& calibration) {
  const v1::CalibrationReport& report = calibration.report();
  const int n = report.parameters().values_size();
  if (n == 0 || calibration.covariance_size() != n * n) return std::nullopt;
  AccuracySources sources;
  sources.model = &calibrated.model;
  sources.lambda = calibrated.lambda;
  const std::vector<int> places = PlacesOf(report);
  for (int place : places) {
    const auto index = calibrated.model.parameters.Find(report.parameters().values(place).name());
    if (!index) return std::nullopt;
    sources.active.push_back(*index);
  }
  const Eigen::MatrixXd all =
      Eigen::Map<const Eigen::MatrixXd>(calibration.covariance().data(), n, n);
  sources.covariance = all(places, places);
  sources.unexplained_m = report.summary().model_sd_position_mm() / kMmPerM;
  sources.unexplained_rad = report.summary().model_sd_rotation_deg() / kDegPerRad;
  sources.p_F_target = TargetOf(report);
  sources.repeatability_m = DeviationOfRepeatability(report.repeatability().iso_rp_mm() / kMmPerM);
  return sources;
}

}  // namespace truepose::convert
