#include "client/agent/sources/session_feed.h"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr size_t kBatch = 500;
constexpr std::chrono::milliseconds kFirstWait(50), kLongestWait(2000);

bool IsWorthWaiting(const absl::Status& status) {
  return status.code() == absl::StatusCode::kResourceExhausted ||
         status.code() == absl::StatusCode::kUnavailable;
}

// 17 and "joints" of "readings[17].joints".
std::optional<std::pair<size_t, std::string>> ReadingOf(const std::string& field) {
  constexpr absl::string_view kPrefix = "readings[";
  const size_t end = field.find(']');
  if (field.compare(0, kPrefix.size(), kPrefix.data(), kPrefix.size()) != 0) return std::nullopt;
  uint64_t index;
  if (end == std::string::npos ||
      !absl::SimpleAtoi(field.substr(kPrefix.size(), end - kPrefix.size()), &index))
    return std::nullopt;
  return std::pair(static_cast<size_t>(index), field.substr(std::min(end + 2, field.size())));
}

}  // namespace

SessionFeed::SessionFeed(ReadingSink& sink, const Stop& stop, std::string place,
                         const FaultReport& report)
    : sink_(sink), stop_(stop), place_(std::move(place)), report_(report) {}

// The spool is full or its disk can't be written: the source holds its input until that is over.
template <class Call>
auto SessionFeed::WaitFor(const Call& call) -> decltype(call()) {
  auto wait = kFirstWait;
  while (true) {
    auto result = call();
    if (!IsWorthWaiting(result.status())) return result;
    if (stop_.WaitFor(wait)) return absl::CancelledError("stopped while the spool took nothing");
    wait = std::min(2 * wait, kLongestWait);
  }
}

absl::Status SessionFeed::Begin(const SessionStart& start) {
  TRUEPOSE_ASSIGN_OR_RETURN(progress_, WaitFor([&] { return sink_.Begin(start); }));
  return absl::OkStatus();
}

absl::Status SessionFeed::Add(v1::Reading reading, int64_t line) {
  batch_.push_back(std::move(reading));
  lines_.push_back(line);
  return batch_.size() < kBatch ? absl::OkStatus() : Flush();
}

absl::Status SessionFeed::Flush() {
  while (!batch_.empty()) {
    const absl::Status status = Append();
    if (status.ok()) break;
    if (status.code() != absl::StatusCode::kInvalidArgument || !LeaveOutFaulty(status))
      return status;
  }
  return absl::OkStatus();
}

absl::Status SessionFeed::Append() {
  const auto appended =
      WaitFor([&] { return sink_.Append(progress_.session, readings_ + 1, batch_); });
  if (!appended.ok()) return appended.status();
  readings_ += static_cast<int64_t>(batch_.size());
  batch_.clear();
  lines_.clear();
  return absl::OkStatus();
}

bool SessionFeed::LeaveOutFaulty(const absl::Status& status) {
  std::vector<bool> faulty(batch_.size());
  for (const Fault& fault : FaultsOf(status)) {
    const auto reading = ReadingOf(fault.field);
    if (!reading.has_value() || reading->first >= batch_.size()) continue;
    faulty[reading->first] = true;
    report_({absl::StrCat(place_, ":", lines_[reading->first], reading->second.empty() ? "" : ": ",
                          reading->second),
             fault.found, fault.expected});
  }
  size_t kept = 0;
  for (size_t i = 0; i < batch_.size(); ++i) {
    if (faulty[i]) continue;
    std::swap(batch_[kept], batch_[i]);
    lines_[kept++] = lines_[i];
  }
  const bool any = kept < batch_.size();
  batch_.resize(kept);
  lines_.resize(kept);
  return any;
}

absl::Status SessionFeed::Seal() {
  TRUEPOSE_RETURN_IF_ERROR(Flush());
  if (readings_ == 0) return absl::OkStatus();
  return WaitFor([&] { return sink_.Seal(progress_.session, readings_); }).status();
}

}  // namespace truepose::agent
