// Resources of any kind for people: their fields in mm and degrees.
#pragma once

#include <string>

#include "client/cli/resource_kind.h"

namespace truepose::cli {

// "Instrument lt-1" and a line for each field that is set.
std::string ResourceText(const ResourceKind& kind, const google::protobuf::Message& resource);

// One line an item of a list's response: id, display name, the kind's columns.
std::string ResourcesTable(const ResourceKind& kind, const google::protobuf::Message& response);

}  // namespace truepose::cli
