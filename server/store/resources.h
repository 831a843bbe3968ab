// Resources without a table of their own, as key columns beside one message: everything of
// plant.proto and recalibration.proto. What they mean, and how their names are made, is decided
// above (server/resource).
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "google/protobuf/message.h"
#include "server/store/page.h"
#include "server/store/transaction.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::store {

struct ResourceKey {
  v1::ResourceKind kind;
  std::string robot_id;  // "" = of the plant
  std::string id;
};

// Inserts or replaces it, and records the event. `name` is the resource's full name.
// @param open whether time alone may change it: ResourceList::only_open finds those.
absl::Status PutResource(Transaction& transaction, const ResourceKey& key, const std::string& name,
                         const google::protobuf::Message& resource, bool deleted,
                         bool open = false);

// One that was stored as open before anybody looked; no event, since nothing of the resource
// changes.
absl::Status CloseResource(Transaction& transaction, const ResourceKey& key);

// The stored bytes, also of a deleted one; nothing when there is none.
absl::StatusOr<std::optional<std::string>> FindResource(Snapshot& snapshot, const ResourceKey& key);

struct ResourceList {
  v1::ResourceKind kind;
  std::optional<std::string> robot_id;  // nothing = of all robots and of the plant
  bool show_deleted = false;
  std::string filter;       // as asked for: what a page token is bound to
  bool only_open = false;   // reads no others
  std::string sha256 = {};  // "" = any; else only tables of this file (table_files.h) are read
};

// Newest last. `visit` gets the bytes of one and returns whether it belongs to the list; those that
// don't count for no page. @returns the token of the next page, "" = this was the last.
absl::StatusOr<std::string> ListResources(
    Snapshot& snapshot, const ResourceList& list, const PageRequest& request,
    const std::function<absl::StatusOr<bool>(const std::string&)>& visit);

}  // namespace truepose::store
