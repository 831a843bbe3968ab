// Standard D&H tables as CSV, for people and other programs (docs/formats.md).
#pragma once

#include <string>

#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

// A line a link, in rad and m: `link,joint,type,theta_rad,d_m,a_m,alpha_rad`. Link 0 is constant,
// from B to the axis of joint 1; links 1 to n are those of the joints at joint value 0; the last,
// without a number, is the flange's constant theta and d. Numbers read back as the same bits.
// @param table n + 2 rows: of B, of the joints, of the flange.
std::string WriteDhTable(const v1::Nominal& nominal, const v1::DhTable& table);

}  // namespace truepose::formats
