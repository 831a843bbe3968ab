#include "convert/export.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "convert/exported_home.h"
#include "convert/frames.h"
#include "convert/report.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/export/dh_table.h"
#include "core/export/joint_frames.h"

namespace truepose::convert {
namespace {

// m; beyond it a d is no length of a robot but an intersection of nearly parallel axes.
constexpr double kLongD_m = 10;
// rad; axes that cross at a larger angle have no distant normal of their own.
constexpr double kNearlyParallel = 0.1;

void AddRow(const DhRow& row, v1::DhTable* table) {
  v1::DhRow* added = table->add_rows();
  added->set_theta_rad(row.theta);
  added->set_d_m(row.d);
  added->set_a_m(row.a);
  added->set_alpha_rad(row.alpha);
}

std::string AxisName(const v1::Nominal& nominal, size_t joint) {
  const size_t n = nominal.joints_size();
  if (joint == 0) return "the base's z";
  return joint > n ? "the flange's z" : nominal.joints(static_cast<int>(joint) - 1).name();
}

// Row `link` lies between the axes of joints `link` and link + 1.
std::string LongD(const v1::Nominal& nominal, size_t link, const DhRow& row) {
  const double angle = std::min(std::abs(row.alpha), std::numbers::pi - std::abs(row.alpha));
  const std::string d = absl::StrFormat("d%d = %.1f m", static_cast<int>(link), row.d);
  if (angle > kNearlyParallel) return d + ", which leads back from a distant common normal";
  return absl::StrFormat(
             "the axes of %s and %s are nearly parallel (%.4f deg), so their common normal is far "
             "away: ",
             AxisName(nominal, link), AxisName(nominal, link + 1), angle * kDegPerRad) +
         d;
}

// What a table of this robot is to be told about, and whether a D&H table can hold it.
struct LongDs {
  std::vector<std::string> texts;
  bool too_long = false;
};

LongDs LongDsOf(const v1::Nominal& nominal, const DhTable& table) {
  LongDs result;
  for (size_t link = 0; link <= table.rows.size(); ++link) {
    const DhRow& row = link == 0 ? table.base : table.rows[link - 1];
    if (std::abs(row.d) <= kLongD_m) continue;
    result.texts.push_back(LongD(nominal, link, row));
    result.too_long = result.too_long || std::abs(row.d) > kLargestLength_m;
  }
  return result;
}

absl::Status TooLongFault(const LongDs& ds) {
  FaultList faults;
  for (const std::string& text : ds.texts)
    faults.Add("geometry", text, "a d of at most 10 km; export as urdf or robot instead");
  return faults.ToStatus();
}

bool IsZero(const DhRow& row) {
  return row.theta == 0 && row.d == 0 && row.a == 0 && row.alpha == 0;
}

void AppendConstant(v1::ElementaryTransform::Motion motion, double value, v1::Geometry* geometry) {
  if (value == 0) return;
  v1::ElementaryTransform* element = geometry->add_flange();
  element->set_motion(motion);
  element->set_axis(v1::Z);
  element->set_constant(value);
}

v1::Geometry GeometryOf(const DhTable& table) {
  v1::Geometry geometry;
  for (const DhRow& row : table.rows) AddRow(row, geometry.mutable_standard_dh());
  AppendConstant(v1::ElementaryTransform::ROTATION, table.flange_theta, &geometry);
  AppendConstant(v1::ElementaryTransform::TRANSLATION, table.flange_d, &geometry);
  return geometry;
}

}  // namespace

absl::StatusOr<ExportedRobot> ExportJointFrames(const v1::Nominal& nominal,
                                                const v1::Calibration* calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Home home,
                            ExportedHome(nominal, calibration, JointSense::kController));
  ExportedRobot exported{nominal, {}};
  *exported.nominal.mutable_geometry() = GeometryOf(home, FramesAlong(home));
  exported.nominal.clear_joint_map();
  exported.nominal.clear_masses();
  exported.nominal.clear_tools();
  return exported;
}

absl::StatusOr<ExportedDh> ExportDhTable(const v1::Nominal& nominal,
                                         const v1::Calibration* calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Home home,
                            ExportedHome(nominal, calibration, JointSense::kChain));
  const DhTable table = DhTableOf(home);
  const LongDs ds = LongDsOf(nominal, table);
  if (ds.too_long) return TooLongFault(ds);
  ExportedDh exported{{}, ds.texts};
  AddRow(table.base, &exported.table);
  for (const DhRow& row : table.rows) AddRow(row, &exported.table);
  AddRow({table.flange_theta, table.flange_d, 0, 0}, &exported.table);
  if (nominal.has_joint_map()) {
    exported.warnings.push_back(
        "the table is in the chain's joints; the robot file's joint_map leads to them from the "
        "controller's");
  }
  return exported;
}

absl::StatusOr<ExportedRobot> ExportRobot(const v1::Nominal& nominal,
                                          const v1::Calibration* calibration) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Home home,
                            ExportedHome(nominal, calibration, JointSense::kChain));
  const DhTable table = DhTableOf(home);
  const LongDs ds = LongDsOf(nominal, table);
  ExportedRobot exported{nominal, ds.texts};
  if (IsZero(table.base) && !ds.too_long) {
    *exported.nominal.mutable_geometry() = GeometryOf(table);
    return exported;
  }
  *exported.nominal.mutable_geometry() = GeometryOf(home, FramesAlong(home));
  exported.warnings.push_back(absl::StrCat(
      "written as a chain of joint frames: standard_dh can't hold this robot, ",
      ds.too_long ? "a d is beyond 10 km" : "the axis of its first joint is not the base's z"));
  return exported;
}

}  // namespace truepose::convert
