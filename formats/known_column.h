// The columns that a table of readings or targets may have, for a robot with n joints, in the order
// of their group:
//   q1..qn (measured), q1_cmd..qn_cmd (commanded): angle of a revolute, length of a prismatic joint
//   tau1..taun: torque | x y z, sx sy sz: length | rx ry rz: angle | qx qy qz qw, axis_x axis_y
//   axis_z: no unit temp: temperature | time, placement, target, group: text
// and of sessions alone
//   distance, distance_sd: length | anchor, beam, feature: text | p1_x p1_y p1_z, p1_sx p1_sy p1_sz
//   ... p9_sz: length
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/unit.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

// Several reflectors on a flange, and some to spare.
inline constexpr int kMostPoints = 9;

enum class Quantity {
  kMeasuredJoint,
  kCommandedJoint,
  kTorque,
  kPosition,
  kQuaternion,
  kEuler,
  kAxis,
  kPositionSd,
  kTemperature,
  kTime,
  kPlacement,
  kTarget,
  kGroup,
  kDistance,
  kDistanceSd,
  kAnchor,
  kBeam,
  kFeature,
  kPoint1,                            // those of the other points follow
  kPoint1Sd = kPoint1 + kMostPoints,  // likewise
};
inline constexpr int kQuantities = static_cast<int>(Quantity::kPoint1Sd) + kMostPoints;

// The quantities of a point, counted from 1.
Quantity PositionOfPoint(int point);
Quantity DeviationOfPoint(int point);

struct KnownColumn {
  std::string stem;  // the name without its unit: "q1_cmd"
  Quantity quantity;
  int index;  // in the group of the quantity
  Dimension dimension;
  bool alone = false;  // its group may be without the others: single coordinates
};

// What targets and sessions may have. @param with_euler false: rx, ry, rz are no known names.
std::vector<KnownColumn> KnownColumns(const v1::Nominal& nominal, bool with_euler);

// What sessions may have; each of x, y, z and of their deviations may stand alone.
std::vector<KnownColumn> SessionColumns(const v1::Nominal& nominal, bool with_euler);

// True when `name` is the column's name; `unit` is then its unit, nullptr for a quantity without
// one.
bool IsNameOf(const KnownColumn& column, std::string_view name, const Unit** unit);

// True when `name` must be meant as that column but is not its name: no unit, another unit, other
// letters. A number's stem with one word behind it is a wrong unit (`x_in`); of texts (`group_2`)
// it is another column.
bool IsSlipOf(const KnownColumn& column, std::string_view name);

// True when `name` is a joint's column for some joint number and unit: `q9_rad`, `q0_cmd_deg`,
// `tau01_Nm`.
bool LooksLikeJoint(std::string_view name);

// The same of a point: `p10_x_mm`, `p0_sz_m`.
bool LooksLikePoint(std::string_view name);

}  // namespace truepose::formats
