// What the tests of formats share: small robots, and a status as its lines.
#pragma once

#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "core/base/fault.h"
#include "gtest/gtest.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

// A robot whose joints have the types of the letters, such as "RRP". Only the joints are set.
inline v1::Nominal RobotOf(std::string_view types) {
  v1::Nominal nominal;
  for (const char type : types) {
    nominal.add_joints()->set_type(type == 'P' ? v1::PRISMATIC : v1::REVOLUTE);
  }
  return nominal;
}

// Each fault as a person reads it; empty for OK.
template <class T>
std::vector<std::string> Faults(const absl::StatusOr<T>& result) {
  std::vector<std::string> lines;
  for (const Fault& fault : FaultsOf(result.status())) lines.push_back(ToString(fault));
  return lines;
}

// The value, or a failed test and a default one.
template <class T>
T ValueOf(absl::StatusOr<T> result) {
  if (result.ok()) return *std::move(result);
  ADD_FAILURE() << result.status();
  return T();
}

inline std::string TextOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  EXPECT_TRUE(stream.is_open()) << path;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace truepose::formats
