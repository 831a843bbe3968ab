// Names of resources to keys of the store and back: instruments/{id}, robots/{robot}/poseSets/{id}.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "server/resource/resource_type.h"
#include "server/store/resources.h"

namespace truepose::resource {

std::string ToName(const ResourceType& type, const store::ResourceKey& key);

// @returns kInvalidArgument with a fault of `field` that shows the form.
absl::StatusOr<store::ResourceKey> ParseName(const ResourceType& type, const std::string& name,
                                             const std::string& field);

// The key of a resource to be made: `parent` is robots/{robot} for those of a robot, else "".
// @returns kInvalidArgument with every fault (fields `parent` and `id_field`).
absl::StatusOr<store::ResourceKey> MakeKey(const ResourceType& type, const std::string& parent,
                                           const std::string& id, const std::string& id_field);

}  // namespace truepose::resource
