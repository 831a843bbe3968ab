// What was found in a program's text: joint targets whose numbers can be replaced where they stand,
// and what was not understood.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "programs/dialect.h"

namespace truepose::programs {

// What a written number of a joint means, for an axis that turns and for one that slides.
enum class Unit {
  kRadOrM,           // URScript
  kDegOrMm,          // KRL, RAPID
  kDegreesFunction,  // URScript's d2r(90): an angle, whatever the joint
};

// One number of a target: bytes [begin, end) of the text, its sign included.
struct JointNumber {
  size_t begin = 0;
  size_t end = 0;
  double value = 0.0;  // as written
  Unit unit = Unit::kRadOrM;
};

struct JointTarget {
  int line = 0;                     // of its first byte, counted from 1
  std::string what;                 // "movej", "PTP", "E6AXIS XP1"
  std::vector<JointNumber> joints;  // in the order of the robot's joints, not of the text

  size_t begin() const;  // of the first number in the text
};

// Something that stays as it is, and why.
struct Remark {
  int line = 0;
  std::string reason;

  bool operator==(const Remark&) const = default;
};

// Both in the order of the text. No byte belongs to two numbers.
struct Program {
  std::vector<JointTarget> targets;
  std::vector<Remark> passed_through;
};

// Reads a program of any content: what is not understood is a remark, never an error. Takes time
// and memory in proportion to the text.
//
// A variable's value counts as a target only where every use of that name in this text is one: a
// value that is calculated with, indexed or handed on means something else as well. Other files are
// not seen.
// @param joints of the robot; it decides only which KRL aggregates are whole (krl.h).
Program ReadProgram(std::string_view text, Dialect dialect, int joints);

}  // namespace truepose::programs
