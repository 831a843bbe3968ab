// Answers of `truepose reproduce`: our figures beside the chapter's, as text and as JSON.
#pragma once

#include <string>
#include <vector>

#include "core/reproduce/section11.h"
#include "core/reproduce/table2.h"
#include "core/reproduce/table3.h"
#include "google/protobuf/struct.pb.h"

namespace truepose::cli {

std::string Table2Text(const Table2Arguments& arguments, const Table2Result& table);
google::protobuf::Struct Table2Json(const Table2Result& table);

std::string Table3Text(const std::vector<Table3Column>& columns);
google::protobuf::Struct Table3Json(const std::vector<Table3Column>& columns);

// Means over the seeds in text, every seed in JSON. Lengths in mm.
std::string Section11Text(const Section11Result& result);
google::protobuf::Struct Section11Json(const Section11Result& result);

}  // namespace truepose::cli
