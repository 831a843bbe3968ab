#include "client/agent/sources/folder_source.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <utility>
#include <vector>

#include "client/agent/sources/csv_source.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

namespace fs = std::filesystem;

// What tells whether a file has changed.
struct Look {
  uintmax_t size = 0;
  fs::file_time_type time;
  bool operator==(const Look&) const = default;
};
using Folder = std::map<std::string, Look>;  // by path

bool IsSessionFile(const fs::path& path) {
  const std::string name = path.filename().string();
  return name[0] != '.' && path.extension() == ".csv";
}

// Files that come or go meanwhile are seen the next time.
Folder LookAt(const std::string& path, std::error_code* error) {
  Folder folder;
  fs::directory_iterator entry(path, *error);
  for (; !*error && entry != fs::directory_iterator(); entry.increment(*error)) {
    std::error_code gone;
    if (!IsSessionFile(entry->path()) || !entry->is_regular_file(gone)) continue;
    const Look look{entry->file_size(gone), entry->last_write_time(gone)};
    if (!gone) folder[entry->path().string()] = look;
  }
  return folder;
}

class Watcher {
 public:
  Watcher(const FolderSourceOptions& options, const FaultReport& report, ReadingSink& sink,
          const Stop& stop)
      : options_(options), report_(report), sink_(sink), stop_(stop) {}

  void Watch() {
    do {
      std::error_code error;
      Folder now = LookAt(options_.path, &error);
      if (error) {
        ReportFolder(error.message());
      } else {
        reported_.clear();
        TakeWhole(now);
      }
    } while (!stop_.WaitFor(options_.poll));
  }

 private:
  // A folder on a drive that is away is told once, not every second.
  void ReportFolder(const std::string& message) {
    if (message == reported_) return;
    reported_ = message;
    report_({options_.path, message, "a folder with session files"});
  }

  void TakeWhole(const Folder& now) {
    Folder taken;  // without files that are gone, so that it never grows beyond the folder
    for (const auto& [path, look] : now) {
      const auto before = seen_.find(path), done = taken_.find(path);
      if (done != taken_.end() && done->second == look) {
        taken[path] = look;
      } else if (before != seen_.end() && before->second == look && Take(path)) {
        taken[path] = look;
      }
      if (stop_.requested()) return;
    }
    taken_ = std::move(taken);
    seen_ = now;
  }

  // @returns false when it was stopped on the way.
  bool Take(const std::string& path) {
    CsvSession session(options_.csv, path, sink_, stop_, report_);
    absl::Status status = ReadAll(path, session);
    if (status.ok()) status = session.End();
    if (status.code() == absl::StatusCode::kCancelled) return false;
    FaultList faults;
    faults.AddAll(status, path);
    for (const Fault& fault : faults.faults()) report_(fault);
    return true;
  }

  absl::Status ReadAll(const std::string& path, CsvSession& session) {
    GrowingFile file(path, kLongestLine);
    auto state = GrowingFile::State::kLines;
    while (state == GrowingFile::State::kLines) {
      if (stop_.requested()) return absl::CancelledError("stopped");
      std::vector<TextLine> lines;
      state = file.Read(&lines);
      if (state == GrowingFile::State::kEnd) file.TakeRest(&lines);
      for (const TextLine& line : lines) TRUEPOSE_RETURN_IF_ERROR(session.Take(line));
    }
    if (state == GrowingFile::State::kEnd) return absl::OkStatus();
    return FaultStatus(path, "a file that can't be read or changed meanwhile", "a whole file");
  }

  const FolderSourceOptions& options_;
  const FaultReport& report_;
  ReadingSink& sink_;
  const Stop& stop_;
  Folder seen_, taken_;
  std::string reported_;
};

}  // namespace

FolderSource::FolderSource(FolderSourceOptions options, FaultReport report)
    : options_(std::move(options)), report_(std::move(report)) {}

absl::Status FolderSource::Run(ReadingSink& sink, const Stop& stop) {
  Watcher(options_, report_, sink, stop).Watch();
  return absl::OkStatus();
}

}  // namespace truepose::agent
