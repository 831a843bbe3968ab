#include "formats/text_file.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/base/fault.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

absl::Status PathFault(absl::StatusCode code, const std::string& path, std::string found) {
  FaultList faults;
  faults.Add(path, std::move(found), "a readable file");
  return faults.ToStatus(code);
}

absl::Status OpenFault(const std::string& path, int error) {
  const bool missing = error == ENOENT || error == ENOTDIR;
  const auto code = missing                             ? absl::StatusCode::kNotFound
                    : error == EACCES || error == EPERM ? absl::StatusCode::kPermissionDenied
                                                        : absl::StatusCode::kInvalidArgument;
  return PathFault(code, path, missing ? "no such file" : std::strerror(error));
}

// A folder opens like a file and then fails to read.
bool IsFolder(const std::string& path) {
  struct stat status;
  return stat(path.c_str(), &status) == 0 && S_ISDIR(status.st_mode);
}

unsigned char ByteAt(std::string_view text, size_t i) {
  return static_cast<unsigned char>(text[i]);
}

// The code point's bits of a lead byte followed by `count` continuation bytes; -1 when one is
// missing.
long Decode(std::string_view text, size_t i, int count, int lead_bits) {
  if (text.size() - i <= static_cast<size_t>(count)) return -1;
  long code = ByteAt(text, i) & ((1 << lead_bits) - 1);
  for (int k = 1; k <= count; ++k) {
    if ((ByteAt(text, i + k) & 0xC0) != 0x80) return -1;
    code = code << 6 | (ByteAt(text, i + k) & 0x3F);
  }
  return code;
}

// Bytes of the character at i, 0 when they are no UTF-8: too long a form, a surrogate, beyond
// U+10FFFF, NUL.
size_t CharacterSize(std::string_view text, size_t i) {
  const unsigned char lead = ByteAt(text, i);
  if (lead < 0x80) return lead != 0;
  if (lead >> 5 == 0x6) return Decode(text, i, 1, 5) >= 0x80 ? 2 : 0;
  if (lead >> 4 == 0xE) {
    const long code = Decode(text, i, 2, 4);
    return code >= 0x800 && code >> 11 != 0x1B ? 3 : 0;
  }
  if (lead >> 3 != 0x1E) return 0;
  const long code = Decode(text, i, 3, 3);
  return code >= 0x10000 && code <= 0x10FFFF ? 4 : 0;
}

}  // namespace

absl::StatusOr<std::string> ReadTextFile(const std::string& path, size_t most_bytes) {
  if (IsFolder(path)) return PathFault(absl::StatusCode::kInvalidArgument, path, "a folder");
  const File file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (file == nullptr) return OpenFault(path, errno);
  std::string text;
  char block[1 << 16];
  while (const size_t n = std::fread(block, 1, sizeof(block), file.get())) {
    text.append(block, n);
    if (text.size() > most_bytes) {
      return FaultStatus(path, "a larger file", StrCat("at most ", most_bytes, " bytes"));
    }
  }
  if (std::ferror(file.get())) return OpenFault(path, errno);
  return text;
}

std::string_view WithoutByteOrderMark(std::string_view text) {
  ConsumePrefix(&text, "\xEF\xBB\xBF");
  return text;
}

size_t FindNotUtf8(std::string_view text) {
  for (size_t i = 0; i < text.size();) {
    const size_t size = CharacterSize(text, i);
    if (size == 0) return i;
    i += size;
  }
  return std::string_view::npos;
}

std::string_view BaseName(std::string_view path) { return path.substr(path.find_last_of('/') + 1); }

}  // namespace truepose::formats
