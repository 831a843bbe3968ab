// One watcher: what its next message is.
//
// Without a revision to resume from it first sends a snapshot. Pages of it are read one after
// another, each from the state of then; the changes since the first page follow within the
// snapshot, without what the pages have shown already. So a watcher never sees a resource step
// back, and no message holds more than a page.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "server/store/events.h"
#include "server/store/store.h"
#include "server/watch/snapshot.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::watch {

class PlantWatch {
 public:
  // @returns kInvalidArgument with every fault of the request; kNotFound for a robot that isn't
  // there; kOutOfRange for a revision that the history doesn't hold, or another store's epoch.
  static absl::StatusOr<std::unique_ptr<PlantWatch>> Begin(store::Store& store,
                                                           const v1::WatchRequest& request);

  // The next message, or nothing when there is none now. One call at a time.
  absl::StatusOr<std::optional<v1::WatchResponse>> Next();
  // A message without events that tells how far the watcher is; nothing while the snapshot isn't
  // complete.
  std::optional<v1::WatchResponse> Bookmark() const;
  // Where a client that has got everything so far may resume; 0 = begin with a snapshot.
  int64_t resume_revision() const { return stage_ == Stage::kChanges ? revision_ : 0; }

 private:
  enum class Stage { kPages, kCatchUp, kChanges };

  PlantWatch(store::Store& store, store::EventFilter filter, int64_t after);

  absl::StatusOr<v1::WatchResponse> NextPage();
  absl::StatusOr<v1::WatchResponse> CatchUp();
  absl::StatusOr<std::optional<v1::WatchResponse>> Changes();
  v1::WatchResponse NewResponse() const;

  store::Store& store_;
  const store::EventFilter filter_;
  Stage stage_;
  SnapshotReader reader_;
  int64_t revision_;  // all up to it is sent; within a snapshot, all up to it is in the pages
  // Resources that a page has shown as of a later revision than the first page's.
  std::map<std::string, int64_t> ahead_;
};

}  // namespace truepose::watch
