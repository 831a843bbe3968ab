// The header of a table's file as a message.
#pragma once

#include "compensation/lookup.h"
#include "truepose/v1/compensation_table.pb.h"

namespace truepose::convert {

v1::CompensationTableHeader HeaderToProto(const compensation::Table& table);

}  // namespace truepose::convert
