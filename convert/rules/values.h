// What numbers of a message may be: finite, of a size that something measured, of unit length.
// Field paths of faults begin with `field`.
#pragma once

#include <string>

#include "core/base/fault.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::convert {

// A quaternion or axis may differ from unit length by this; files round to 9 digits, some to 6.
inline constexpr double kUnitTolerance = 1e-6;

// Adds faults below `field` for values that are not finite or a quaternion that is not a unit one.
void CheckPose(const v1::Pose& pose, const std::string& field, FaultList* faults);
// Each part of at most kLargestLength_m.
void CheckVector(const v1::Vector3& vector, const std::string& field, FaultList* faults);
void CheckQuaternion(const v1::Quaternion& quaternion, const std::string& field, FaultList* faults);
void CheckFinite(double value, const std::string& field, FaultList* faults);

// Sizes beyond which a reading is no measurement but a slip of units or columns. Far above any
// instrument (a tracker sees 160 m) and any encoder, and small enough that squares stay finite.
inline constexpr double kLargestLength_m = 1e4;
inline constexpr double kLargestJoint = 1e6;  // rad or m
// " m" or " rad" by the end of a field's name, else "": what stands behind its numbers in faults.
const char* UnitOf(const std::string& field);
// A fault for a value that is not finite or larger than `largest`.
void CheckSize(double value, double largest, const std::string& field, FaultList* faults);

}  // namespace truepose::convert
