// Which fields an update changes (AIP-134): those of the mask; without one, all that may be
// changed.
#pragma once

#include "absl/status/status.h"
#include "google/protobuf/field_mask.pb.h"
#include "google/protobuf/message.h"
#include "server/resource/resource_type.h"

namespace truepose::resource {

// Changes `target` by the fields of `source`. A field that is masked and absent in `source` is
// cleared.
// @returns kInvalidArgument with a fault (`update_mask`) for each path that is none, or that only
// the server sets.
absl::Status ApplyUpdate(const google::protobuf::Message& source,
                         const google::protobuf::FieldMask& mask,
                         const std::vector<std::string>& output_only,
                         google::protobuf::Message& target);

}  // namespace truepose::resource
