// The numbers of joints between a program's text and rad or m.
#pragma once

#include <string>
#include <string_view>

#include "programs/program.h"

namespace truepose::programs {

// rad or m for 1 of the unit; 0 when the joint can't have that unit.
double SiPerUnit(Unit unit, bool prismatic);

// `value` in the unit of the program, without exponent: as many decimals as `as_written` has, but
// at least 8 for rad and m, 6 for degrees and mm, and at most 10. Never "-0.000000". With a + where
// there was one.
// @param after_name the number stands right behind a name, as in A4-1.5: a sign has to part them.
std::string WriteNumber(double value, Unit unit, std::string_view as_written,
                        bool after_name = false);

// Half a unit of the last decimal that WriteNumber gives.
double PrintedPrecision(Unit unit, std::string_view as_written);

}  // namespace truepose::programs
