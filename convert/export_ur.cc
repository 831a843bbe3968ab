#include <array>
#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "convert/digest.h"
#include "convert/export.h"
#include "convert/exported_home.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/export/dh_table.h"
#include "core/export/joint_frames.h"

namespace truepose::convert {
namespace {

constexpr int kJoints = 6;
// m, rad; data sheets and ROS files are rounded to 1e-9 and worse.
constexpr double kTolerance = 1e-6;
constexpr std::array<double, kJoints> kAlpha_quarters = {1, 0, 0, 1, -1, 0};

bool IsSmall(double value) { return std::abs(value) < kTolerance; }

bool IsUrRow(const DhRow& row, int i) {
  const bool long_link = i == 1 || i == 2;
  return IsSmall(row.theta) && IsSmall(row.alpha - kAlpha_quarters[i] * std::numbers::pi / 2) &&
         IsSmall(long_link ? row.d : row.a);
}

bool IsUrLike(const Home& home) {
  if (home.axes.size() != kJoints) return false;
  for (const JointAxis& axis : home.axes) {
    if (axis.type != JointType::kRevolute) return false;
  }
  const DhTable table = DhTableOf(home);
  bool is = IsSmall(table.base.theta) && IsSmall(table.base.d) && IsSmall(table.base.a) &&
            IsSmall(table.base.alpha) && IsSmall(table.flange_theta) && IsSmall(table.flange_d);
  for (int i = 0; i < kJoints; ++i) is = is && IsUrRow(table.rows[i], i);
  return is;
}

// Of ur_description: behind the joint's theta and d, before the link's a and alpha.
std::vector<Pose> NominalFrames(const Home& home) {
  std::vector<Pose> frames;
  Pose X;
  for (const DhRow& row : DhTableOf(home).rows) {
    const Chain to_joint = {Rotation(Axis::kZ, row.theta), Translation(Axis::kZ, row.d)};
    const Chain to_next = {Translation(Axis::kX, row.a), Rotation(Axis::kX, row.alpha)};
    X = X * Forward<double>(to_joint, nullptr, nullptr);
    frames.push_back(X);
    X = X * Forward<double>(to_next, nullptr, nullptr);
  }
  return frames;
}

// wrist_3 is the flange, so F has to stand on the last axis; it does in every internal model, which
// has nothing behind the last joint.
absl::Status CheckFlange(const Home& home) {
  const JointAxis& last = home.axes.back();
  const Pose on_axis = FrameOn(last, home.X_BF);
  if ((on_axis.p - home.X_BF.p).norm() < 1e-12 && (on_axis.R - home.X_BF.R).norm() < 1e-12)
    return absl::OkStatus();
  return FaultStatus("robot", "a flange that is not on the axis of joint 6", "one that is");
}

}  // namespace

absl::StatusOr<ExportedRobot> ExportUrCalibration(const v1::Nominal& nominal,
                                                  const v1::Calibration* calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Home as_designed,
                            ExportedHome(nominal, nullptr, JointSense::kController));
  if (!IsUrLike(as_designed)) {
    return FaultStatus(
        "robot", "a robot that is not built as those of Universal Robots",
        "six revolute joints with standard D&H theta 0, alpha 90, 0, 0, 90, -90, 0 "
        "deg, a in rows 2 and 3 only, no d there, no flange; export as urdf instead");
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const Home home,
                            ExportedHome(nominal, calibration, JointSense::kController));
  TRUEPOSE_RETURN_IF_ERROR(CheckFlange(home));
  std::vector<Pose> frames = NominalFrames(as_designed);
  for (size_t i = 0; i < frames.size(); ++i) frames[i] = FrameOn(home.axes[i], frames[i]);
  frames.back() = home.X_BF;
  ExportedRobot exported{nominal, {}};
  *exported.nominal.mutable_geometry() = GeometryOf(home, frames);
  exported.nominal.clear_joint_map();
  return exported;
}

std::string UrHash(const v1::Nominal& nominal, const v1::Calibration* calibration) {
  std::string text = NominalDigest(nominal);
  if (calibration != nullptr) {
    text = CalibrationDigest(calibration->report().convention(), text, *calibration);
  }
  uint64_t number = 0;
  for (const char c : text.substr(0, 16)) {
    number = 16 * number + static_cast<uint64_t>(c <= '9' ? c - '0' : c - 'a' + 10);
  }
  return absl::StrCat("calib_", number);
}

}  // namespace truepose::convert
