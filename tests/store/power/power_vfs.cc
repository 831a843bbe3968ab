#include "tests/store/power/power_vfs.h"

#include <sqlite3.h>

#include <utility>

namespace truepose::store {
namespace {

// As SQLite allocates it: the file of the system's VFS follows behind.
struct PowerFile {
  sqlite3_file base;
  SimulatedDisk* disk;
  SimulatedDisk::Inode* inode;  // nullptr: a temporary file, which nobody misses
  bool folder_pending;          // its first sync makes its name durable, as the system's VFS does

  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
};

PowerFile* Of(sqlite3_file* file) { return reinterpret_cast<PowerFile*>(file); }

const sqlite3_io_methods& Real(sqlite3_file* file) { return *Of(file)->real()->pMethods; }

int Close(sqlite3_file* file) { return Real(file).xClose(Of(file)->real()); }

int Read(sqlite3_file* file, void* out, int size, sqlite3_int64 offset) {
  return Real(file).xRead(Of(file)->real(), out, size, offset);
}

int Write(sqlite3_file* file, const void* bytes, int size, sqlite3_int64 offset) {
  PowerFile& own = *Of(file);
  const std::string_view text(static_cast<const char*>(bytes), size);
  sqlite3_int64 length = 0;
  Real(file).xFileSize(own.real(), &length);
  if (!own.disk->HasRoomFor(offset + size - length)) return SQLITE_FULL;
  if (own.inode != nullptr && !own.disk->Write(own.inode, offset, text)) return SQLITE_IOERR_WRITE;
  return Real(file).xWrite(own.real(), bytes, size, offset);
}

int Truncate(sqlite3_file* file, sqlite3_int64 size) {
  PowerFile& own = *Of(file);
  if (own.inode != nullptr && !own.disk->Truncate(own.inode, size)) return SQLITE_IOERR_TRUNCATE;
  return Real(file).xTruncate(own.real(), size);
}

// The real file needs no sync: Recover writes it anew.
int Sync(sqlite3_file* file, int) {
  PowerFile& own = *Of(file);
  if (own.inode == nullptr) return SQLITE_OK;
  const bool with_folder = std::exchange(own.folder_pending, false);
  return own.disk->Sync(own.inode, with_folder) ? SQLITE_OK : SQLITE_IOERR_FSYNC;
}

int FileSize(sqlite3_file* file, sqlite3_int64* size) {
  return Real(file).xFileSize(Of(file)->real(), size);
}
int Lock(sqlite3_file* file, int level) { return Real(file).xLock(Of(file)->real(), level); }
int Unlock(sqlite3_file* file, int level) { return Real(file).xUnlock(Of(file)->real(), level); }
int CheckReserved(sqlite3_file* file, int* out) {
  return Real(file).xCheckReservedLock(Of(file)->real(), out);
}
int Control(sqlite3_file* file, int what, void* argument) {
  return Real(file).xFileControl(Of(file)->real(), what, argument);
}
int SectorSize(sqlite3_file* file) { return Real(file).xSectorSize(Of(file)->real()); }
int Characteristics(sqlite3_file* file) {
  return Real(file).xDeviceCharacteristics(Of(file)->real());
}
int ShmMap(sqlite3_file* file, int page, int size, int extend, void volatile** out) {
  return Real(file).xShmMap(Of(file)->real(), page, size, extend, out);
}
int ShmLock(sqlite3_file* file, int offset, int count, int flags) {
  return Real(file).xShmLock(Of(file)->real(), offset, count, flags);
}
void ShmBarrier(sqlite3_file* file) { Real(file).xShmBarrier(Of(file)->real()); }
int ShmUnmap(sqlite3_file* file, int remove) {
  return Real(file).xShmUnmap(Of(file)->real(), remove);
}

// Version 2: without memory-mapped files, whose writes nobody would see.
constexpr sqlite3_io_methods kMethods = {
    .iVersion = 2,
    .xClose = Close,
    .xRead = Read,
    .xWrite = Write,
    .xTruncate = Truncate,
    .xSync = Sync,
    .xFileSize = FileSize,
    .xLock = Lock,
    .xUnlock = Unlock,
    .xCheckReservedLock = CheckReserved,
    .xFileControl = Control,
    .xSectorSize = SectorSize,
    .xDeviceCharacteristics = Characteristics,
    .xShmMap = ShmMap,
    .xShmLock = ShmLock,
    .xShmBarrier = ShmBarrier,
    .xShmUnmap = ShmUnmap,
    .xFetch = nullptr,
    .xUnfetch = nullptr,
};

constexpr int kJournals = SQLITE_OPEN_MAIN_JOURNAL | SQLITE_OPEN_WAL | SQLITE_OPEN_SUPER_JOURNAL;

}  // namespace

struct PowerVfs::Parts {
  SimulatedDisk* disk;
  sqlite3_vfs* system;
  sqlite3_vfs vfs;
};

namespace {

template <typename Parts>
int Open(sqlite3_vfs* vfs, const char* name, sqlite3_file* file, int flags, int* out_flags) {
  const Parts& parts = *static_cast<Parts*>(vfs->pAppData);
  PowerFile& own = *Of(file);
  own = {.base = {nullptr}, .disk = parts.disk, .inode = nullptr, .folder_pending = false};
  const bool kept = name != nullptr && (flags & SQLITE_OPEN_DELETEONCLOSE) == 0;
  const bool may_create = (flags & SQLITE_OPEN_CREATE) != 0;
  if (kept && parts.disk->is_off()) return SQLITE_CANTOPEN;
  // Told first, since it looks whether the file is there.
  if (kept) own.inode = parts.disk->Open(name, may_create);
  own.folder_pending = may_create && (flags & kJournals) != 0;
  const int code = parts.system->xOpen(parts.system, name, own.real(), flags, out_flags);
  if (code == SQLITE_OK) own.base.pMethods = &kMethods;
  return code;
}

template <typename Parts>
int Delete(sqlite3_vfs* vfs, const char* name, int sync_folder) {
  const Parts& parts = *static_cast<Parts*>(vfs->pAppData);
  if (!parts.disk->Delete(name, sync_folder != 0)) return SQLITE_IOERR_DELETE;
  return parts.system->xDelete(parts.system, name, 0);
}

}  // namespace

// The system's other functions look at nothing of the VFS that they are called for, so they are
// taken over as they are.
PowerVfs::PowerVfs(SimulatedDisk& disk) : parts_(std::make_unique<Parts>()) {
  sqlite3_vfs* const system = sqlite3_vfs_find(nullptr);
  *parts_ = {.disk = &disk, .system = system, .vfs = *system};
  parts_->vfs.szOsFile = static_cast<int>(sizeof(PowerFile)) + system->szOsFile;
  parts_->vfs.zName = "power";
  parts_->vfs.pNext = nullptr;
  parts_->vfs.pAppData = parts_.get();
  parts_->vfs.xOpen = Open<Parts>;
  parts_->vfs.xDelete = Delete<Parts>;
  sqlite3_vfs_register(&parts_->vfs, 1);
}

PowerVfs::~PowerVfs() {
  sqlite3_vfs_unregister(&parts_->vfs);
  sqlite3_vfs_register(parts_->system, 1);
}

}  // namespace truepose::store
