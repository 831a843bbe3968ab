// Readings whose figures fit the robot only in another unit. Hints and not faults: a reading may be
// as odd as that for a reason. They go with a report as warnings, and with the faults of a run that
// failed, whose cause they may be.
#pragma once

#include <string>
#include <vector>

#include "convert/run.h"
#include "core/robot/robot.h"

namespace truepose::convert {

// A sentence each, of one session:
//   revolute joints beyond two turns under rad: "joint elbow is read at up to 322 rad: ...";
//   measured positions whose extent is a hundredth, or a hundred times, that of the flange at the
//   same joints by the nominal robot (the larger side of their bounding box; at least 10 mm of the
//   flange): "positions span 2 mm, ...". Factors of a hundred since metres and millimetres differ
//   by a thousand, and a target at the end of a lever at most by ten.
std::vector<std::string> UnitHints(const v1::Nominal& nominal, const Robot& robot,
                                   const v1::SessionInput& session);

}  // namespace truepose::convert
