// What the content of each kind must hold: every fault, with the field's path within the message.
#pragma once

#include "core/base/fault.h"
#include "google/protobuf/message.h"

namespace truepose::resource {

using google::protobuf::Message;

void CheckNothing(const Message& content, FaultList& faults);
void CheckInstrument(const Message& content, FaultList& faults);
void CheckTool(const Message& content, FaultList& faults);
// The features as convert/fixture.h checks them in a file.
void CheckFixture(const Message& content, FaultList& faults);
void CheckTarget(const Message& content, FaultList& faults);
void CheckPlacement(const Message& content, FaultList& faults);
// Poses must be there, and of equal numbers of joints; whether that is the robot's is checked with
// the robot.
void CheckPoseSet(const Message& content, FaultList& faults);
void CheckRobotEvent(const Message& content, FaultList& faults);
void CheckRecalibrationPolicy(const Message& content, FaultList& faults);
void CheckAgentReport(const Message& content, FaultList& faults);
// The spec as convert/table_spec.h checks it without a robot.
void CheckCompensationTable(const Message& content, FaultList& faults);

}  // namespace truepose::resource
