#include "tests/store/power/simulated_disk.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include "tests/store/testing/temporary_folder.h"

namespace truepose::store {
namespace {

void Apply(const SimulatedDisk::Change& change, std::string& content) {
  if (!change.bytes.has_value()) return content.resize(change.offset);
  const size_t end = change.offset + change.bytes->size();
  if (content.size() < end) content.resize(end);
  content.replace(change.offset, change.bytes->size(), *change.bytes);
}

}  // namespace

void SimulatedDisk::CutPowerAt(int64_t change) {
  const std::lock_guard lock(mutex_);
  changes_left_ = change;
}

bool SimulatedDisk::is_off() const {
  const std::lock_guard lock(mutex_);
  return off_;
}

void SimulatedDisk::SetFull(bool full) {
  const std::lock_guard lock(mutex_);
  full_ = full;
}

bool SimulatedDisk::HasRoomFor(int64_t growth) const {
  const std::lock_guard lock(mutex_);
  return !full_ || growth <= 0;
}

bool SimulatedDisk::Begin(bool* last) {
  if (off_) return false;
  *last = changes_left_ > 0 && --changes_left_ == 0;
  off_ = *last;
  return true;
}

SimulatedDisk::Inode* SimulatedDisk::Open(const std::string& path, bool may_create) {
  const std::lock_guard lock(mutex_);
  const auto known = names_.find(path);
  if (known != names_.end()) return known->second;
  const bool exists = std::filesystem::exists(path);
  if (!exists && !may_create) return nullptr;
  inodes_.push_back(std::make_unique<Inode>());
  Inode* inode = inodes_.back().get();
  names_[path] = inode;
  if (exists) {
    inode->durable = ReadFile(path);
    durable_names_[path] = inode;
  } else {
    pending_names_.push_back({path, inode});
  }
  return inode;
}

bool SimulatedDisk::Write(Inode* inode, int64_t offset, std::string_view bytes) {
  const std::lock_guard lock(mutex_);
  bool last = false;
  if (!Begin(&last)) return false;
  inode->pending.push_back({offset, std::string(bytes)});
  return !last;
}

bool SimulatedDisk::Truncate(Inode* inode, int64_t size) {
  const std::lock_guard lock(mutex_);
  bool last = false;
  if (!Begin(&last)) return false;
  inode->pending.push_back({size, std::nullopt});
  return !last;
}

// A sync that the power loss interrupts has written what it has: that is what Recover draws.
bool SimulatedDisk::Sync(Inode* inode, bool with_folder) {
  const std::lock_guard lock(mutex_);
  bool last = false;
  if (!Begin(&last) || last) return false;
  Settle(*inode);
  if (with_folder) SettleFolder();
  return true;
}

bool SimulatedDisk::Delete(const std::string& path, bool with_folder) {
  const std::lock_guard lock(mutex_);
  bool last = false;
  if (!Begin(&last)) return false;
  names_.erase(path);
  pending_names_.push_back({path, nullptr});
  if (last) return false;
  if (with_folder) SettleFolder();
  return true;
}

void SimulatedDisk::Settle(Inode& inode) {
  for (const Change& change : inode.pending) Apply(change, inode.durable);
  inode.pending.clear();
}

void SimulatedDisk::SettleFolder() {
  durable_names_ = names_;
  pending_names_.clear();
}

void SimulatedDisk::Tear(const Change& write, std::string& content) {
  const int64_t end = write.offset + static_cast<int64_t>(write.bytes->size());
  for (int64_t begin = write.offset; begin < end;) {
    const int64_t next = std::min(end, (begin / kSectorBytes + 1) * kSectorBytes);
    if (Draw(0.5)) Apply({begin, write.bytes->substr(begin - write.offset, next - begin)}, content);
    begin = next;
  }
}

std::string SimulatedDisk::Survivor(const Inode& inode, double keep) {
  std::string content = inode.durable;
  for (const Change& change : inode.pending) {
    if (Draw(keep)) {
      Apply(change, content);
    } else if (change.bytes.has_value() && Draw(keep)) {
      Tear(change, content);
    }
  }
  return content;
}

void SimulatedDisk::Recover() {
  const std::lock_guard lock(mutex_);
  // From "nothing reached the disk by itself" to "nearly all did".
  const double keep = std::uniform_int_distribution<int>(0, 4)(random_) / 4.2;
  Folder left = durable_names_;
  for (const Rename& rename : pending_names_) {
    if (!Draw(keep)) continue;
    if (rename.inode == nullptr) left.erase(rename.path);
    if (rename.inode != nullptr) left[rename.path] = rename.inode;
  }
  std::set<std::string> paths;
  for (const auto& folder : {names_, durable_names_})
    for (const auto& [path, inode] : folder) paths.insert(path);
  for (const std::string& path : paths) std::filesystem::remove(path);
  for (const auto& [path, inode] : left) WriteFile(path, Survivor(*inode, keep));
  inodes_.clear();
  names_.clear();
  durable_names_.clear();
  pending_names_.clear();
  changes_left_ = 0;
  off_ = false;
}

}  // namespace truepose::store
