#include "client/agent/sources/csv_source.h"

#include <memory>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

using Clock = std::chrono::steady_clock;
using FileState = GrowingFile::State;

// Follows one path through all the files that it names.
class Follower {
 public:
  Follower(const CsvSourceOptions& options, const FaultReport& report, ReadingSink& sink,
           const Stop& stop)
      : options_(options),
        report_(report),
        sink_(sink),
        stop_(stop),
        file_(options.path, kLongestLine) {
    StartAnew();
  }

  absl::Status Follow() {
    while (!stop_.requested()) {
      std::vector<TextLine> lines;
      const FileState state = file_.Read(&lines);
      if (!lines.empty()) last_line_ = Clock::now();
      Use(lines);
      Use(state);
      if (state == FileState::kEnd || state == FileState::kMissing) stop_.WaitFor(options_.poll);
    }
    Guard(session_ != nullptr ? session_->Flush() : absl::OkStatus());
    return absl::OkStatus();
  }

 private:
  void StartAnew() {
    session_ = std::make_unique<CsvSession>(options_.csv, options_.path, sink_, stop_, report_);
    last_line_ = Clock::now();
    was_idle_ = false;
  }

  // What ends a session is for a person to see to; the next file may be good again.
  void Guard(const absl::Status& status) {
    if (status.ok() || status.code() == absl::StatusCode::kCancelled) return;
    session_.reset();
    FaultList faults;
    faults.AddAll(status, options_.path);
    for (const Fault& fault : faults.faults()) report_(fault);
  }

  void Use(const std::vector<TextLine>& lines) {
    for (const TextLine& line : lines) {
      if (session_ != nullptr) {
        Guard(session_->Take(line));
      } else if (std::exchange(was_idle_, false)) {
        report_({absl::StrCat(options_.path, ":", line.number),
                 absl::StrCat("a line after the session was sealed, since none came for ",
                              options_.seal_after.count() / 1000.0,
                              " s: it is not taken, nor are more"),
                 "a new file, or a longer seal_after_s"});
      }
    }
  }

  void Use(FileState state) {
    if (state == FileState::kRewritten) {
      report_({options_.path, "what was read already is gone or has changed",
               "a file that only grows; its readings so far are kept, and it is read anew"});
    }
    const bool over = state == FileState::kRewritten || state == FileState::kReplaced;
    if (session_ != nullptr && (over || IsIdle(state))) {
      Guard(session_->End());
      // Further lines would be of a sealed session.
      if (!over && session_ != nullptr) was_idle_ = true;
      if (!over) session_.reset();
    } else if (session_ != nullptr && state == FileState::kEnd) {
      Guard(session_->Flush());
    }
    if (over) StartAnew();
  }

  bool IsIdle(FileState state) const {
    return state == FileState::kEnd && options_.seal_after.count() > 0 && session_->begun() &&
           Clock::now() - last_line_ >= options_.seal_after;
  }

  const CsvSourceOptions& options_;
  const FaultReport& report_;
  ReadingSink& sink_;
  const Stop& stop_;
  GrowingFile file_;
  std::unique_ptr<CsvSession> session_;  // nullptr: nothing of this file is used any more
  bool was_idle_ = false;                // and therefore sealed; no line has come since
  Clock::time_point last_line_;
};

}  // namespace

CsvSource::CsvSource(CsvSourceOptions options, FaultReport report)
    : options_(std::move(options)), report_(std::move(report)) {}

absl::Status CsvSource::Run(ReadingSink& sink, const Stop& stop) {
  return Follower(options_, report_, sink, stop).Follow();
}

}  // namespace truepose::agent
