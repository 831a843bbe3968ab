// The kinds that live in the store's table of resources.
#pragma once

#include <span>

#include "server/resource/resource_type.h"

namespace truepose::resource {

std::span<const ResourceType> AllTypes();

// The type whose message is `descriptor`'s, or of this kind; nullptr for resources with tables of
// their own.
const ResourceType* FindType(const google::protobuf::Descriptor* descriptor);
const ResourceType* FindType(v1::ResourceKind kind);

}  // namespace truepose::resource
