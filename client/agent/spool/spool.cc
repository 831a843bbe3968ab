#include "client/agent/spool/spool.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr char kOpenSuffix[] = ".spool";
constexpr char kDoneSuffix[] = ".done";
constexpr size_t kUuidSize = 36;

std::string NameOf(const std::filesystem::path& file) {
  return absl::StrCat("sessions/", file.stem().string());
}

std::vector<std::filesystem::path> FilesOf(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

absl::Status MakeFolder(const std::string& path) {
  std::error_code error;
  std::filesystem::create_directories(path, error);
  if (error) return absl::UnavailableError(absl::StrCat(path, ": ", error.message()));
  return chmod(path.c_str(), 0700) == 0 ? absl::OkStatus() : DiskError(path);
}

DoneSession DoneOf(const std::filesystem::path& file) {
  struct stat status {};
  stat(file.c_str(), &status);
  return {NameOf(file), std::chrono::system_clock::from_time_t(status.st_mtime), status.st_size};
}

// Of what the source said; the time is when it said so.
std::string BytesOf(v1::Session content) {
  content.clear_create_time();
  return content.SerializeAsString();
}

absl::Status Refusal(absl::StatusCode code, const std::string& found, const char* expected) {
  FaultList faults;
  faults.Add("session", found, expected);
  return faults.ToStatus(code);
}

}  // namespace

Spool::Spool(const SpoolOptions& options, Disk& disk, std::unique_ptr<FolderLock> lock)
    : disk_(disk),
      folder_(options.folder),
      sessions_folder_(options.folder + "/sessions"),
      lock_(std::move(lock)),
      budget_(options.largest_bytes) {}

absl::StatusOr<std::unique_ptr<Spool>> Spool::Open(const SpoolOptions& options, Disk& disk) {
  TRUEPOSE_RETURN_IF_ERROR(MakeFolder(options.folder));
  TRUEPOSE_ASSIGN_OR_RETURN(auto lock, FolderLock::Acquire(options.folder));
  TRUEPOSE_RETURN_IF_ERROR(MakeFolder(options.folder + "/sessions"));
  std::unique_ptr<Spool> spool(new Spool(options, disk, std::move(lock)));
  TRUEPOSE_RETURN_IF_ERROR(spool->Load());
  return spool;
}

absl::Status Spool::Load() {
  for (const std::filesystem::path& file : FilesOf(sessions_folder_)) {
    if (file.stem().string().size() != kUuidSize) continue;
    if (file.extension() == kDoneSuffix) {
      const DoneSession done = DoneOf(file);
      budget_.Take(done.bytes);
      done_[done.session] = done;
    } else if (file.extension() == kOpenSuffix) {
      const absl::Status status = LoadOne(file.string());
      if (!status.ok()) notes_.push_back(std::string(status.message()));
    }
  }
  std::stable_sort(order_.begin(), order_.end(), [&](const auto& a, const auto& b) {
    return sessions_[a]->content().create_time().seconds() <
           sessions_[b]->content().create_time().seconds();
  });
  return absl::OkStatus();
}

absl::Status Spool::LoadOne(const std::string& file) {
  auto session = SessionFile::Open(disk_, budget_, file);
  if (absl::IsDataLoss(session.status())) {
    // For a person to see; out of the way of a source that begins this session again.
    std::rename(file.c_str(), FreshPath(file + ".unreadable").c_str());
  }
  TRUEPOSE_RETURN_IF_ERROR(session.status());
  if ((*session)->cut_bytes() > 0)
    notes_.push_back(absl::StrCat(file, ": ", (*session)->cut_bytes(),
                                  " bytes behind the last whole record were cut"));
  const std::string name = (*session)->content().name();
  sessions_[name] = *std::move(session);
  order_.push_back(name);
  return absl::OkStatus();
}

std::string Spool::PathOf(const std::string& name, const char* suffix) const {
  return absl::StrCat(sessions_folder_, "/", name.substr(name.find('/') + 1), suffix);
}

absl::StatusOr<Spool::Session> Spool::Begin(const v1::Session& content,
                                            const std::string& request) {
  std::lock_guard lock(mutex_);
  if (done_.count(content.name()) > 0)
    return Refusal(absl::StatusCode::kFailedPrecondition, content.name() + ", which is delivered",
                   "another session");
  const auto found = sessions_.find(content.name());
  if (found != sessions_.end()) {
    if (BytesOf(found->second->content()) == BytesOf(content)) return found->second;
    return Refusal(absl::StatusCode::kAlreadyExists, content.name() + " with other values",
                   "a new UUID");
  }
  TRUEPOSE_ASSIGN_OR_RETURN(
      auto made,
      SessionFile::Create(disk_, budget_, PathOf(content.name(), kOpenSuffix), content, request));
  order_.push_back(content.name());
  return sessions_[content.name()] = std::move(made);
}

Spool::Session Spool::Find(const std::string& name) const {
  std::lock_guard lock(mutex_);
  const auto found = sessions_.find(name);
  return found == sessions_.end() ? nullptr : found->second;
}

std::vector<Spool::Session> Spool::Sessions() const {
  std::lock_guard lock(mutex_);
  std::vector<Session> sessions;
  for (const std::string& name : order_) sessions.push_back(sessions_.at(name));
  return sessions;
}

absl::Status Spool::SetDone(const std::string& name) {
  std::lock_guard lock(mutex_);
  const std::string path = PathOf(name, kDoneSuffix), open = PathOf(name, kOpenSuffix);
  // The seal here may be older by as long as the server was away.
  if (utimensat(AT_FDCWD, open.c_str(), nullptr, 0) != 0) return DiskError(open);
  if (std::rename(open.c_str(), path.c_str()) != 0) return DiskError(path);
  const DoneSession done = DoneOf(path);
  // What the session gives back when the last user has let it go.
  budget_.Take(done.bytes);
  done_[name] = done;
  sessions_.erase(name);
  std::erase(order_, name);
  return SyncFolder(disk_, sessions_folder_);
}

std::vector<DoneSession> Spool::Done() const {
  std::lock_guard lock(mutex_);
  std::vector<DoneSession> done;
  for (const auto& [name, session] : done_) done.push_back(session);
  return done;
}

bool Spool::IsDone(const std::string& name) const {
  std::lock_guard lock(mutex_);
  return done_.count(name) > 0;
}

absl::StatusOr<int64_t> Spool::DoneReadings(const std::string& name) const {
  Budget unlimited(0);
  TRUEPOSE_ASSIGN_OR_RETURN(const auto file,
                            SessionFile::Open(disk_, unlimited, PathOf(name, kDoneSuffix)));
  return file->readings();
}

absl::StatusOr<Spool::Session> Spool::Reopen(const std::string& name) {
  std::lock_guard lock(mutex_);
  const std::string path = PathOf(name, kOpenSuffix);
  const auto found = done_.find(name);
  if (found == done_.end()) return absl::NotFoundError(name + " is not done");
  if (std::rename(PathOf(name, kDoneSuffix).c_str(), path.c_str()) != 0) return DiskError(path);
  auto session = SessionFile::Open(disk_, budget_, path);
  if (!session.ok()) {
    std::rename(path.c_str(), PathOf(name, kDoneSuffix).c_str());
    return session.status();
  }
  budget_.Give(found->second.bytes);
  done_.erase(found);
  order_.push_back(name);
  return sessions_[name] = *std::move(session);
}

absl::Status Spool::Remove(const std::string& name) {
  std::lock_guard lock(mutex_);
  const auto found = done_.find(name);
  if (found == done_.end()) return absl::NotFoundError(name + " is not done");
  const std::string path = PathOf(name, kDoneSuffix);
  if (unlink(path.c_str()) != 0) return DiskError(path);
  budget_.Give(found->second.bytes);
  done_.erase(found);
  const std::string cut = PathOf(name, ".cut");
  unlink(cut.c_str());
  for (int number = 2; unlink(absl::StrCat(cut, ".", number).c_str()) == 0;) ++number;
  return SyncFolder(disk_, sessions_folder_);
}

absl::Status Spool::RemoveEmpty(const std::string& name) {
  std::lock_guard lock(mutex_);
  const auto found = sessions_.find(name);
  if (found == sessions_.end()) return absl::NotFoundError(name);
  if (!found->second->CloseIfEmpty()) return absl::FailedPreconditionError(name + " has readings");
  const std::string path = PathOf(name, kOpenSuffix);
  if (unlink(path.c_str()) != 0) return DiskError(path);
  sessions_.erase(found);
  std::erase(order_, name);
  return SyncFolder(disk_, sessions_folder_);
}

}  // namespace truepose::agent
