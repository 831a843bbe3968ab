#include "client/agent/sources/json_source.h"

#include <memory>
#include <utility>

#include "absl/strings/str_cat.h"
#include "client/agent/sources/csv_source.h"
#include "client/agent/sources/json_line.h"
#include "client/agent/sources/line_stream.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

class Reader {
 public:
  Reader(const JsonSourceOptions& options, const FaultReport& report, ReadingSink& sink,
         const Stop& stop)
      : options_(options),
        report_(report),
        sink_(sink),
        stop_(stop),
        stream_(options.descriptor, kLongestLine) {}

  void ReadAll() {
    while (const std::optional<TextLine> line = stream_.Next(stop_)) {
      Guard(Take(*line), line->number);
      if (feed_ != nullptr && stream_.WouldWait()) Guard(feed_->Flush(), line->number);
    }
    if (feed_ != nullptr) Guard(feed_->Flush(), 0);
  }

 private:
  std::string PlaceOf(int64_t line) const { return absl::StrCat(options_.place, ":", line); }

  // A fault of a line leaves the session as it is; anything else is of the session.
  void Guard(const absl::Status& status, int64_t line) {
    if (status.ok() || status.code() == absl::StatusCode::kCancelled) return;
    if (!is_line_fault_) {
      feed_.reset();
      refused_ = true;
    }
    FaultList faults;
    faults.AddAll(status, is_line_fault_ ? "" : PlaceOf(line));
    for (const Fault& fault : faults.faults()) report_(fault);
  }

  absl::Status Take(const TextLine& line) {
    is_line_fault_ = true;
    if (line.cut) {
      return FaultStatus(PlaceOf(line.number),
                         absl::StrCat("more than ", line.text.size(), " bytes"), "a shorter line");
    }
    if (line.text.find_first_not_of(" \t") == std::string::npos) return absl::OkStatus();
    TRUEPOSE_ASSIGN_OR_RETURN(JsonLine parsed,
                              ParseJsonLine(line.text, PlaceOf(line.number), options_.content));
    if (auto* reading = std::get_if<v1::Reading>(&parsed))
      return TakeReading(std::move(*reading), line.number);
    is_line_fault_ = false;
    if (auto* start = std::get_if<SessionStart>(&parsed)) return Begin(std::move(*start));
    return Seal();
  }

  absl::Status Begin(SessionStart start) {
    if (feed_ != nullptr) TRUEPOSE_RETURN_IF_ERROR(feed_->Flush());
    v1::Session content = options_.content;
    content.MergeFrom(start.content);
    start.content = std::move(content);
    if (start.content.source().empty()) start.content.set_source(options_.place);
    refused_ = false;
    if (options_.settle.has_value()) settled_.emplace(*options_.settle);
    feed_ = std::make_unique<SessionFeed>(sink_, stop_, options_.place, report_);
    return feed_->Begin(start);
  }

  absl::Status TakeReading(v1::Reading reading, int64_t line) {
    if (refused_) {
      return FaultStatus(PlaceOf(line), "a reading of a session that was refused or sealed",
                         "a begin before it");
    }
    is_line_fault_ = false;
    if (feed_ == nullptr) TRUEPOSE_RETURN_IF_ERROR(Begin({}));
    if (settled_.has_value()) {
      is_line_fault_ = true;
      const std::optional<absl::Time> time = TimeOf(reading);
      if (!time.has_value())
        return FaultStatus(PlaceOf(line) + ": time", "'" + reading.time() + "'",
                           "a time with offset");
      if (!settled_->Add(reading, *time)) return absl::OkStatus();
      is_line_fault_ = false;
    }
    if (feed_->was_sealed()) return absl::OkStatus();
    return feed_->Add(std::move(reading), line);
  }

  absl::Status Seal() {
    if (feed_ == nullptr) {
      is_line_fault_ = true;
      return FaultStatus(options_.place, "a seal without a session", "a begin before it");
    }
    const std::unique_ptr<SessionFeed> feed = std::move(feed_);
    refused_ = true;  // until the next begin
    return feed->was_sealed() ? absl::OkStatus() : feed->Seal();
  }

  const JsonSourceOptions& options_;
  const FaultReport& report_;
  ReadingSink& sink_;
  const Stop& stop_;
  LineStream stream_;
  std::unique_ptr<SessionFeed> feed_;
  std::optional<Settled> settled_;
  bool refused_ = false;
  bool is_line_fault_ = false;  // of the status that Take returned
};

}  // namespace

JsonSource::JsonSource(JsonSourceOptions options, FaultReport report)
    : options_(std::move(options)), report_(std::move(report)) {}

absl::Status JsonSource::Run(ReadingSink& sink, const Stop& stop) {
  Reader(options_, report_, sink, stop).ReadAll();
  return absl::OkStatus();
}

}  // namespace truepose::agent
