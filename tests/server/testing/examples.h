// A robot and readings that every check accepts.
#pragma once

#include <string>

#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/services.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::testing {

inline constexpr char kSession1[] = "00000000-0000-4000-8000-000000000001";
inline constexpr char kSession2[] = "00000000-0000-4000-8000-000000000002";
inline constexpr char kJob1[] = "00000000-0000-4000-8000-00000000000a";
inline constexpr char kJob2[] = "00000000-0000-4000-8000-00000000000b";
inline constexpr char kUnknown[] = "ffffffff-ffff-4fff-8fff-ffffffffffff";

// Six revolute joints in standard D&H, with limits.
v1::Nominal SixAxes(const std::string& serial = "1");

v1::CreateRobotRequest RobotRequest(const std::string& robot_id, const std::string& serial = "1");
v1::CreateSessionRequest SessionRequest(const std::string& session_id, const std::string& robot);

inline constexpr int kCalibrationPoses = 60;

// What a robot like SixAxes() measures whose parameters are a little off; the same errors for the
// same seed.
v1::SessionInput SimulatedSession(int poses, unsigned seed);

// Rows `first` to `first + count - 1` with joints and a position that differ from row to row.
v1::AppendReadingsRequest Batch(const std::string& session_id, int first, int count);

}  // namespace truepose::testing
