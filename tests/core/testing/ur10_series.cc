#include "tests/core/testing/ur10_series.h"

#include "tests/core/testing/table.h"

namespace truepose::testing {
namespace {

// Columns of the file.
constexpr int kPosition = 6, kQuaternion = 12, kScatter = 16;

Reading ReadingOf(const std::vector<double>& row) {
  Reading reading;
  reading.q = Eigen::Map<const Eigen::VectorXd>(row.data(), 6);
  reading.X_MT.p = 1e-3 * Eigen::Map<const Eigen::Vector3d>(&row[kPosition]);
  reading.X_MT.R = RotationOf<double>(
      Eigen::Vector4d(Eigen::Map<const Eigen::Vector4d>(&row[kQuaternion])).normalized());
  reading.axis_M = reading.X_MT.R.col(2);
  reading.position_sd_m = 1e-3 * Eigen::Map<const Eigen::Vector3d>(&row[kScatter]);
  return reading;
}

}  // namespace

std::vector<Reading> LoadUr10CalibrationHalf(const std::string& name) {
  std::vector<Reading> readings;
  int row = 0;
  for (const auto& values : ReadTable(SharedFolder() + "/data/ipa_ur10/series_" + name + ".csv")) {
    if (row % 2 == 0) {
      readings.push_back(ReadingOf(values));
      readings.back().id = row;
    }
    ++row;
  }
  return readings;
}

Pose Ur10Target() { return {Eigen::Matrix3d::Identity(), Eigen::Vector3d(0, 0, 0.109)}; }

}  // namespace truepose::testing
