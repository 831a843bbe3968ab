#include "client/agent/released/released_cache.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr char kList[] = "/released.json";

absl::Status MakeFolder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) return absl::OkStatus();
  return absl::UnavailableError(absl::StrCat(folder, ": ", error.message()));
}

}  // namespace

absl::StatusOr<std::vector<ReleasedEntry>> ReleasedCache::Entries() const {
  std::ifstream file(folder_ + kList, std::ios::binary);
  if (!file) return std::vector<ReleasedEntry>();
  std::ostringstream text;
  text << file.rdbuf();
  auto entries = EntriesFromJson(text.str(), robot_);
  if (entries.ok()) return entries;
  return absl::Status(entries.status().code(),
                      absl::StrCat(folder_, kList, ": ", std::string(entries.status().message())));
}

bool ReleasedCache::Has(const std::string& sha256) const {
  std::error_code ignored;
  return std::filesystem::is_regular_file(PathOf(sha256), ignored);
}

absl::StatusOr<std::shared_ptr<const ReleasedSet>> ReleasedCache::Read(
    const ReleasedEntry& entry) const {
  return ReleasedSet::Map(PathOf(entry.sha256), robot_, entry);
}

absl::Status ReleasedCache::Put(const std::string& sha256, std::string_view bytes) {
  TRUEPOSE_RETURN_IF_ERROR(MakeFolder(folder_));
  return ReplaceFile(disk_, PathOf(sha256), bytes);
}

void ReleasedCache::Remove(const std::string& sha256) {
  std::error_code ignored;
  std::filesystem::remove(PathOf(sha256), ignored);
}

absl::Status ReleasedCache::Link(const std::string& sha256) {
  const std::string target = sha256 + ".table", made = active_path() + ".new";
  std::error_code ignored;
  if (std::filesystem::read_symlink(active_path(), ignored) == target) return absl::OkStatus();
  std::filesystem::remove(made, ignored);
  if (symlink(target.c_str(), made.c_str()) != 0) return DiskError(made);
  if (std::rename(made.c_str(), active_path().c_str()) != 0) return DiskError(active_path());
  return SyncFolder(disk_, folder_);
}

void ReleasedCache::RemoveOthers(const std::vector<ReleasedEntry>& sets) {
  std::set<std::string> kept;
  for (const ReleasedEntry& entry : sets) kept.insert(entry.sha256 + ".table");
  std::error_code ignored;
  for (const auto& file : std::filesystem::directory_iterator(folder_, ignored)) {
    const std::string name = file.path().filename().string();
    // Also what a process left behind that ended while it wrote.
    if (absl::StrContains(name, ".table") && !file.is_symlink(ignored) && !kept.contains(name))
      std::filesystem::remove(file.path(), ignored);
  }
}

absl::Status ReleasedCache::Release(const std::vector<ReleasedEntry>& sets) {
  TRUEPOSE_RETURN_IF_ERROR(MakeFolder(folder_));
  TRUEPOSE_RETURN_IF_ERROR(ReplaceFile(disk_, folder_ + kList, ToJson(robot_, sets)));
  TRUEPOSE_RETURN_IF_ERROR(Link(sets.front().sha256));
  RemoveOthers(sets);
  return absl::OkStatus();
}

}  // namespace truepose::agent
