#include "compensation/table_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace truepose::compensation {
namespace {

// Closes on every way out; the mapping does not need it.
class Descriptor {
 public:
  // Not blocking: a pipe of that name is refused, not waited for.
  explicit Descriptor(const char* path) : number_(open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {}
  ~Descriptor() {
    if (number_ >= 0) close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

TableReport NotOpened(const char* path) {
  return Refused(TableFault::kNotOpened, "%.160s: %s", path, std::strerror(errno));
}

}  // namespace

TableFile::TableFile(TableFile&& other) noexcept
    : mapping_(std::exchange(other.mapping_, nullptr)),
      size_(std::exchange(other.size_, 0)),
      table_(other.table_) {}

TableFile& TableFile::operator=(TableFile&& other) noexcept {
  std::swap(mapping_, other.mapping_);
  std::swap(size_, other.size_);
  std::swap(table_, other.table_);
  return *this;
}

TableFile::~TableFile() {
  if (mapping_ != nullptr) munmap(mapping_, size_);
}

TableReport TableFile::Read(const TableExpectation& expectation) noexcept {
  return ReadTable({static_cast<const std::byte*>(mapping_), size_}, expectation, &table_);
}

TableReport TableFile::Map(const char* path, const TableExpectation& expectation,
                           TableFile* file) noexcept {
  const Descriptor descriptor(path);
  struct stat status;
  if (descriptor.number() < 0 || fstat(descriptor.number(), &status) != 0) return NotOpened(path);
  if (!S_ISREG(status.st_mode))
    return Refused(TableFault::kNotOpened, "%.160s: not a regular file", path);
  if (status.st_size == 0) return Refused(TableFault::kTruncated, "%.160s: found 0 bytes", path);
  TableFile read;
  const std::size_t size = static_cast<std::size_t>(status.st_size);
  void* mapping = mmap(nullptr, size, PROT_READ, MAP_SHARED | MAP_POPULATE, descriptor.number(), 0);
  if (mapping == MAP_FAILED) return NotOpened(path);
  read.mapping_ = mapping;
  read.size_ = size;
  const TableReport report = read.Read(expectation);
  if (report.ok()) *file = std::move(read);
  return report;
}

TableReport TableFile::Copy(std::span<const std::byte> bytes, const TableExpectation& expectation,
                            TableFile* file) noexcept {
  if (bytes.empty()) return Refused(TableFault::kTruncated, "found 0 bytes");
  TableFile read;
  void* mapping =
      mmap(nullptr, bytes.size(), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapping == MAP_FAILED)
    return Refused(TableFault::kNoMemory, "no memory for %zu bytes", bytes.size());
  read.mapping_ = mapping;
  read.size_ = bytes.size();
  std::memcpy(mapping, bytes.data(), bytes.size());
  mprotect(mapping, bytes.size(), PROT_READ);  // an optional guard: nothing writes there
  const TableReport report = read.Read(expectation);
  if (report.ok()) *file = std::move(read);
  return report;
}

}  // namespace truepose::compensation
