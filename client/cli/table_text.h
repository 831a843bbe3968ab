// The header of a compensation table as a page for people: mm and deg.
#pragma once

#include <string>

#include "truepose/v1/compensation_table.pb.h"

namespace truepose::cli {

std::string TableText(const v1::CompensationTableHeader& header);

// "q2 + q3 - q4" of the weights of one coordinate.
std::string CoordinateText(const v1::CompensationTableAxis& axis);

}  // namespace truepose::cli
