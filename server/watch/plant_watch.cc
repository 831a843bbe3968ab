#include "server/watch/plant_watch.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/robots.h"

namespace truepose::watch {
namespace {

using store::Snapshot;

// A stalled watcher holds one message, as an object and as bytes on their way, so this is what 200 of
// them cost.
constexpr int kMostEvents = 200;
constexpr int64_t kMostBytes = 16 * 1024;

void CheckKinds(const v1::WatchRequest& request, FaultList& faults) {
  for (int i = 0; i < request.kinds_size(); ++i) {
    const auto kind = request.kinds(i);
    if (kind != v1::RESOURCE_KIND_UNSPECIFIED && v1::ResourceKind_IsValid(kind)) continue;
    faults.Add(absl::StrCat("kinds[", i, "]"), absl::StrCat(static_cast<int>(kind)),
               "a kind of resource such as KIND_JOB");
  }
}

absl::Status CheckRequest(const v1::WatchRequest& request) {
  FaultList faults;
  if (!request.robot().empty())
    faults.AddAll(store::ParseRobotName(request.robot(), "robot").status());
  CheckKinds(request, faults);
  if (request.after_revision() < 0)
    faults.Add("after_revision", absl::StrCat(request.after_revision()), "0 or a revision");
  if (request.after_revision() > 0 && request.epoch().empty())
    faults.Add("epoch", "nothing", "the epoch that came with after_revision");
  return faults.ToStatus();
}

absl::Status CheckEpoch(const store::Store& store, const v1::WatchRequest& request) {
  if (request.after_revision() == 0 || request.epoch() == store.epoch()) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kOutOfRange, "epoch", request.epoch(),
                        absl::StrCat(store.epoch(),
                                     ", this store's; begin with a new snapshot "
                                     "(after_revision 0)"));
}

store::EventFilter FilterOf(const v1::WatchRequest& request) {
  store::EventFilter filter;
  if (!request.robot().empty()) filter.robot_id = *store::ParseRobotName(request.robot());
  for (const int kind : request.kinds()) filter.kinds.insert(static_cast<v1::ResourceKind>(kind));
  filter.name = request.resource();
  return filter;
}

}  // namespace

absl::StatusOr<std::unique_ptr<PlantWatch>> PlantWatch::Begin(store::Store& store,
                                                              const v1::WatchRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRequest(request));
  TRUEPOSE_RETURN_IF_ERROR(CheckEpoch(store, request));
  store::EventFilter filter = FilterOf(request);
  TRUEPOSE_RETURN_IF_ERROR(store.Read([&](Snapshot& snapshot) -> absl::Status {
    if (!filter.robot_id.empty())
      TRUEPOSE_RETURN_IF_ERROR(store::GetRobot(snapshot, request.robot()).status());
    if (request.after_revision() == 0) return absl::OkStatus();
    return store::EventsAfter(snapshot, request.after_revision(), filter, 1, 1).status();
  }));
  return std::unique_ptr<PlantWatch>(
      new PlantWatch(store, std::move(filter), request.after_revision()));
}

PlantWatch::PlantWatch(store::Store& store, store::EventFilter filter, int64_t after)
    : store_(store),
      filter_(filter),
      stage_(after == 0 ? Stage::kPages : Stage::kChanges),
      reader_(std::move(filter)),
      revision_(after) {}

absl::StatusOr<std::optional<v1::WatchResponse>> PlantWatch::Next() {
  switch (stage_) {
    case Stage::kPages:
      return NextPage();
    case Stage::kCatchUp:
      return CatchUp();
    case Stage::kChanges:
      break;
  }
  return Changes();
}

std::optional<v1::WatchResponse> PlantWatch::Bookmark() const {
  if (stage_ != Stage::kChanges) return std::nullopt;
  return NewResponse();
}

v1::WatchResponse PlantWatch::NewResponse() const {
  v1::WatchResponse response;
  response.set_epoch(store_.epoch());
  response.set_revision(resume_revision());
  return response;
}

absl::StatusOr<v1::WatchResponse> PlantWatch::NextPage() {
  if (revision_ == 0) {
    TRUEPOSE_ASSIGN_OR_RETURN(revision_, store_.Revision());
  }
  TRUEPOSE_ASSIGN_OR_RETURN(
      std::vector<v1::WatchEvent> events,
      store_.Read([this](Snapshot& snapshot) { return reader_.NextPage(snapshot); }));
  reader_.Advance();
  v1::WatchResponse response = NewResponse();
  response.set_snapshot(true);
  for (v1::WatchEvent& event : events) {
    if (event.revision() > revision_) ahead_[event.name()] = event.revision();
    *response.add_events() = std::move(event);
  }
  if (reader_.is_done()) stage_ = Stage::kCatchUp;
  return response;
}

absl::StatusOr<v1::WatchResponse> PlantWatch::CatchUp() {
  TRUEPOSE_ASSIGN_OR_RETURN(store::EventBatch batch, store_.Read([this](Snapshot& snapshot) {
    return store::EventsAfter(snapshot, revision_, filter_, kMostEvents, kMostBytes);
  }));
  revision_ = batch.revision;
  if (!batch.has_more) stage_ = Stage::kChanges;
  v1::WatchResponse response = NewResponse();
  response.set_snapshot(true);
  response.set_snapshot_complete(!batch.has_more);
  for (v1::WatchEvent& event : batch.events) {
    const auto shown = ahead_.find(event.name());
    if (shown != ahead_.end() && event.revision() <= shown->second) continue;
    *response.add_events() = std::move(event);
  }
  if (!batch.has_more) ahead_.clear();
  return response;
}

absl::StatusOr<std::optional<v1::WatchResponse>> PlantWatch::Changes() {
  TRUEPOSE_ASSIGN_OR_RETURN(store::EventBatch batch, store_.Read([this](Snapshot& snapshot) {
    return store::EventsAfter(snapshot, revision_, filter_, kMostEvents, kMostBytes);
  }));
  revision_ = batch.revision;
  if (batch.events.empty() && !batch.has_more) return std::optional<v1::WatchResponse>();
  v1::WatchResponse response = NewResponse();
  for (v1::WatchEvent& event : batch.events) *response.add_events() = std::move(event);
  return std::optional(std::move(response));
}

}  // namespace truepose::watch
