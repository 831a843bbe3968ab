// Create, get, list, update, delete and undelete of a resource, each within one transaction or
// snapshot.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "absl/status/status.h"
#include "google/protobuf/field_mask.pb.h"
#include "google/protobuf/message.h"
#include "server/resource/resource_type.h"
#include "server/store/resources.h"

namespace truepose::resource {

// Stores `content` under the key and gives the stored state in `resource`. The same content again
// gives what there is. `content` may hold output-only fields that a caller within the server has
// set.
// @returns kInvalidArgument with every fault of the content, fields prefixed by `field` + ".";
// kNotFound for a robot that isn't there (field `parent`); kAlreadyExists for another content, or a
// deleted one.
absl::Status Create(store::Transaction& transaction, const ResourceType& type,
                    const store::ResourceKey& key, const google::protobuf::Message& content,
                    const std::string& field, google::protobuf::Message& resource);

// Also of a deleted resource, whose delete_time is set. @returns kNotFound with a fault of `field`.
absl::Status Get(store::Snapshot& snapshot, const ResourceType& type, const std::string& name,
                 const std::string& field, google::protobuf::Message& resource);

// Changes what the mask names. @returns kAborted when the etag of `changes` isn't the stored one's;
// kNotFound, also for a deleted one; faults of mask and content.
absl::Status Update(store::Transaction& transaction, const ResourceType& type,
                    const google::protobuf::Message& changes,
                    const google::protobuf::FieldMask& mask, const std::string& field,
                    google::protobuf::Message& resource);

// Writes a new state of a stored resource as it is: for fields that only the server sets.
absl::Status Replace(store::Transaction& transaction, const ResourceType& type,
                     google::protobuf::Message& resource);

// @returns kNotFound; kAborted for the etag. Deleting a deleted one, and undeleting one that isn't,
// changes nothing.
absl::Status Delete(store::Transaction& transaction, const ResourceType& type,
                    const std::string& name, const std::string& etag,
                    google::protobuf::Message& resource);
absl::Status Undelete(store::Transaction& transaction, const ResourceType& type,
                      const std::string& name, google::protobuf::Message& resource);

struct ListAsked {
  std::string parent;  // robots/{robot}, "" = of all robots
  store::PageRequest page;
  std::string filter;
  bool show_deleted = false;
  bool only_open = false;  // ResourceType::is_open
};

// Oldest first. `add` makes room for the next item. @returns the token of the next page.
absl::StatusOr<std::string> List(store::Snapshot& snapshot, const ResourceType& type,
                                 const ListAsked& asked,
                                 const std::function<google::protobuf::Message*()>& add);

}  // namespace truepose::resource
