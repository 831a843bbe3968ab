#include "client/agent/sources/growing_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace truepose::agent {
namespace {

constexpr size_t kBlock = 64 << 10;
constexpr size_t kTail = 64;

ssize_t ReadAt(int descriptor, char* block, size_t size, off_t offset) {
  ssize_t n;
  do {
    n = pread(descriptor, block, size, offset);
  } while (n < 0 && errno == EINTR);
  return n;
}

}  // namespace

GrowingFile::GrowingFile(std::string path, size_t longest_line)
    : path_(std::move(path)), longest_line_(longest_line) {}

GrowingFile::~GrowingFile() { Close(); }

bool GrowingFile::Open() {
  if (descriptor_ < 0) descriptor_ = open(path_.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  return descriptor_ >= 0;
}

void GrowingFile::Close() {
  if (descriptor_ >= 0) close(descriptor_);
  descriptor_ = -1;
  offset_ = 0;
  lines_ = 0;
  rest_.clear();
  tail_.clear();
  rest_is_cut_ = false;
}

GrowingFile::State GrowingFile::Read(std::vector<TextLine>* lines) {
  if (!Open()) return State::kMissing;
  if (IsRewritten()) {
    Close();
    return State::kRewritten;
  }
  char block[kBlock];
  const ssize_t n = ReadAt(descriptor_, block, sizeof(block), offset_);
  if (n < 0) {
    Close();
    return State::kMissing;
  }
  if (n == 0) return AtEnd(lines);
  Split(block, static_cast<size_t>(n), lines);
  Remember(block, static_cast<size_t>(n));
  offset_ += n;
  return State::kLines;
}

// A file that was cut off may have grown beyond the old place by the time we look, so its length
// alone does not tell.
bool GrowingFile::IsRewritten() const {
  struct stat status;
  if (fstat(descriptor_, &status) == 0 && status.st_size < offset_) return true;
  if (tail_.empty()) return false;
  char now[kTail];
  const ssize_t n =
      ReadAt(descriptor_, now, tail_.size(), offset_ - static_cast<off_t>(tail_.size()));
  return n != static_cast<ssize_t>(tail_.size()) ||
         std::memcmp(now, tail_.data(), tail_.size()) != 0;
}

bool GrowingFile::IsReplaced() const {
  struct stat ours, named;
  if (fstat(descriptor_, &ours) != 0 || stat(path_.c_str(), &named) != 0) return false;
  return ours.st_dev != named.st_dev || ours.st_ino != named.st_ino;
}

GrowingFile::State GrowingFile::AtEnd(std::vector<TextLine>* lines) {
  if (!IsReplaced()) return State::kEnd;
  // Whoever had it open may have written between our last read and the renaming.
  char byte;
  if (ReadAt(descriptor_, &byte, 1, offset_) > 0) return State::kLines;
  TakeRest(lines);
  Close();
  return State::kReplaced;
}

void GrowingFile::Split(const char* block, size_t size, std::vector<TextLine>* lines) {
  const char* const end = block + size;
  while (block < end) {
    const char* line_end = std::find(block, end, '\n');
    AppendToRest(block, static_cast<size_t>(line_end - block));
    if (line_end == end) return;
    EndLine(lines);
    block = line_end + 1;
  }
}

void GrowingFile::AppendToRest(const char* begin, size_t size) {
  const size_t room = longest_line_ - std::min(longest_line_, rest_.size());
  rest_is_cut_ = rest_is_cut_ || size > room;
  rest_.append(begin, std::min(size, room));
}

void GrowingFile::EndLine(std::vector<TextLine>* lines) {
  if (!rest_.empty() && rest_.back() == '\r') rest_.pop_back();
  lines->push_back({++lines_, std::exchange(rest_, {}), std::exchange(rest_is_cut_, false)});
}

void GrowingFile::TakeRest(std::vector<TextLine>* lines) {
  if (!rest_.empty()) EndLine(lines);
}

void GrowingFile::Remember(const char* block, size_t size) {
  const size_t kept = std::min(size, kTail);
  tail_.append(block + size - kept, kept);
  if (tail_.size() > kTail) tail_.erase(0, tail_.size() - kTail);
}

}  // namespace truepose::agent
