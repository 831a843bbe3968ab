// A kind of resource: all that the standard methods have to know about it.
#pragma once

#include <string>
#include <vector>

#include "core/base/fault.h"
#include "google/protobuf/message.h"
#include "server/store/resources.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::resource {

struct ResourceType {
  v1::ResourceKind kind;
  const google::protobuf::Message* prototype;  // default instance
  std::string collection;                      // "poseSets"
  bool of_robot = false;                       // robots/{robot}/{collection}/{id}
  bool uuid_ids = false;                       // else [a-z0-9][a-z0-9-]{0,62}
  // Fields beside the standard ones that only the server sets.
  std::vector<std::string> output_only = {};
  // Every fault of the content, fields without prefix.
  void (*check)(const google::protobuf::Message& content, FaultList& faults) = nullptr;
  // The same by what else is stored (stored_checks.h); nullptr = nothing to check.
  absl::Status (*check_within)(store::Transaction& transaction, const store::ResourceKey& key,
                               const google::protobuf::Message& content,
                               FaultList& faults) = nullptr;
  // Whether time alone may change it: what looks for those that are due reads no others. nullptr =
  // never.
  bool (*is_open)(const google::protobuf::Message& resource) = nullptr;
  // Fields whose change raises `version`; none = it has no version.
  std::vector<std::string> versioned = {};
};

// name, uid, create_time, update_time, delete_time, revision, etag, version: set by the server.
bool IsStandardField(const std::string& field);

}  // namespace truepose::resource
