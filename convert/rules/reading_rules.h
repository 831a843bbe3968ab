// What a reading must be, wherever it comes in: the service, files, the agent's interfaces. Needs
// messages only, so that a program without the mathematics has the same rules.
#pragma once

#include <string>

#include "core/base/fault.h"
#include "truepose/v1/session.pb.h"

namespace truepose::convert {

// Every fault of a reading of a robot with so many joints, field paths below `field`: a wrong
// number of joints, values that are not finite or larger than values.h allows, a quaternion or axis
// that is not of unit length, negative standard deviations, points or distances without their
// names.
void CheckReading(const v1::Reading& reading, int joints, const std::string& field,
                  FaultList* faults);

// Answers most readings without the texts of field paths: true only when CheckReading finds
// nothing, false when that has to look.
bool IsSound(const v1::Reading& reading, int joints);

}  // namespace truepose::convert
