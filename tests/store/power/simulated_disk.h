// What a loss of power leaves of files.
//
// A write is durable once its file was synced, a name once its folder was. What is not durable when
// the power goes survives or not, each change for itself, and a write also in part, sector by
// sector; bytes outside of the written range are never touched (SQLite's "powersafe overwrite",
// which every disk of today keeps). All functions are safe from any thread.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace truepose::store {

class SimulatedDisk {
 public:
  static constexpr int64_t kSectorBytes = 512;

  struct Change {
    int64_t offset = 0;                // of a write; the new size of a truncation
    std::optional<std::string> bytes;  // nothing = a truncation
  };
  // A file, whatever its name is by now.
  struct Inode {
    std::string durable;
    std::vector<Change> pending;  // since the last sync, in order
  };

  explicit SimulatedDisk(uint64_t seed) : random_(seed) {}

  // The power goes with the `change`-th change from now, which is still under way then. 0 = never.
  void CutPowerAt(int64_t change);
  bool is_off() const;
  // A full disk still takes writes within a file, but none that makes it longer.
  void SetFull(bool full);

  // A file that is there already is taken as durable.
  Inode* Open(const std::string& path, bool may_create);
  bool HasRoomFor(int64_t growth) const;
  // Each is one change. false: the power is off, nothing happens any more.
  bool Write(Inode* inode, int64_t offset, std::string_view bytes);
  bool Truncate(Inode* inode, int64_t size);
  bool Sync(Inode* inode, bool with_folder);
  bool Delete(const std::string& path, bool with_folder);

  // Writes what survives over the real files, with the power on again. No file may be open.
  void Recover();

 private:
  struct Rename {
    std::string path;
    Inode* inode;  // nullptr = deleted
  };
  using Folder = std::map<std::string, Inode*>;

  // Counts a change. @returns whether the power is still on before it; `last`: goes with it.
  bool Begin(bool* last);
  void Settle(Inode& inode);
  void SettleFolder();
  std::string Survivor(const Inode& inode, double keep);
  void Tear(const Change& write, std::string& content);
  bool Draw(double probability) { return std::bernoulli_distribution(probability)(random_); }

  mutable std::mutex mutex_;
  std::mt19937_64 random_;
  int64_t changes_left_ = 0;  // 0 = no cut is planned
  bool off_ = false, full_ = false;
  std::vector<std::unique_ptr<Inode>> inodes_;
  Folder names_, durable_names_;
  std::vector<Rename> pending_names_;
};

}  // namespace truepose::store
