// What there is when a watch begins: robots, open sessions, jobs that have not ended, active
// calibrations, open recalibration requests, each robot's latest state of everything else. With one
// resource named, that one in any state.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "server/store/events.h"
#include "server/store/transaction.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::watch {

// Reads page by page, each from a state of its own: later pages may show later commits. What was
// shown too early is left to the caller, who knows the revisions.
class SnapshotReader {
 public:
  explicit SnapshotReader(store::EventFilter filter);

  bool is_done() const { return kind_ == kinds_.size(); }
  // The next page; may be empty before the end.
  absl::StatusOr<std::vector<v1::WatchEvent>> NextPage(store::Snapshot& snapshot);
  // Takes the page that was read as sent: the next call gives what follows. Apart, since a read may
  // run twice.
  void Advance();

 private:
  const store::EventFilter filter_;
  std::vector<v1::ResourceKind> kinds_;
  size_t kind_ = 0;
  std::string page_token_, next_token_;
};

}  // namespace truepose::watch
