// The standard commands of every kind of resource.
#pragma once

#include "client/cli/command_line.h"
#include "client/cli/resource_kind.h"

namespace truepose::cli {

// update, delete, undelete.
void AddResourceChanges(const Command& group, const ResourceKind& kind);

// `truepose WORD create|show|list` and the changes.
void AddResource(const Command& root, const ResourceKind& kind);

}  // namespace truepose::cli
