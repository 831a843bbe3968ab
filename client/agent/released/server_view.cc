#include "client/agent/released/server_view.h"

#include "absl/strings/str_cat.h"

namespace truepose::agent {

v1::WatchRequest ServerView::RequestOf(const std::string& robot) {
  v1::WatchRequest request;
  request.set_robot(robot);
  request.add_kinds(v1::KIND_ROBOT);
  request.add_kinds(v1::KIND_CALIBRATION);
  request.add_kinds(v1::KIND_COMPENSATION_TABLE);
  return request;
}

void ServerView::TakeEvent(const v1::WatchEvent& event) {
  if (event.has_robot()) robot_ = event.robot();
  if (event.has_compensation_table()) tables_[event.name()] = event.compensation_table();
  if (!event.has_calibration()) return;
  for (const v1::ReleaseStep& step : event.calibration().release_steps()) {
    if (step.state() != v1::ACTIVE) continue;
    activations_[event.name()] = {step.time().seconds() * 1'000'000 + step.time().nanos() / 1'000,
                                  event.calibration().revision()};
  }
}

bool ServerView::Take(const v1::WatchResponse& response) {
  if (response.snapshot() && !in_snapshot_) *this = {};
  for (const v1::WatchEvent& event : response.events()) TakeEvent(event);
  in_snapshot_ = response.snapshot() && !response.snapshot_complete();
  return !in_snapshot_;
}

std::optional<ReleasedEntry> ServerView::Released() const {
  const auto found = tables_.find(robot_.active_compensation_table());
  if (found == tables_.end() || found->second.state() != v1::TABLE_READY) return std::nullopt;
  const v1::CompensationTable& table = found->second;
  ReleasedEntry entry;
  entry.table = table.name();
  entry.sha256 = table.sha256();
  entry.calibration = table.calibration();
  entry.calibration_digest = table.calibration_digest();
  entry.nominal_digest = table.nominal_digest();
  entry.serial = robot_.nominal_revision().nominal().serial();
  const auto activation = activations_.find(entry.calibration);
  if (activation == activations_.end()) return std::nullopt;
  entry.activated_us = activation->second.time_us;
  entry.revision = activation->second.revision;
  return entry;
}

const v1::CompensationTable* ServerView::TableOfActive() const {
  const v1::CompensationTable* last = nullptr;
  for (const auto& [name, table] : tables_) {
    const bool better = last == nullptr || last->state() == v1::TABLE_FAILED;
    if (better && table.calibration() == robot_.active_calibration()) last = &table;
  }
  return last;
}

bool ServerView::HasFailed() const {
  const v1::CompensationTable* const table = TableOfActive();
  return !active_calibration().empty() && table != nullptr && table->state() == v1::TABLE_FAILED;
}

std::string ServerView::WhyNone() const {
  const std::string& active = robot_.active_calibration();
  if (active.empty()) return "the server has no active calibration of it";
  const v1::CompensationTable* const table = TableOfActive();
  if (table == nullptr) return absl::StrCat("no table of ", ShortName(active), " was asked for");
  if (!HasFailed()) return absl::StrCat("the table of ", ShortName(active), " is not READY yet");
  return absl::StrCat("the table of ", ShortName(active), " FAILED: ", table->error().message());
}

}  // namespace truepose::agent
