#include "server/store/reading_batch.h"

#include <cstdint>

namespace truepose::store {
namespace {

// Field 1 as a varint: the row, which comes first in a reading's bytes.
constexpr char kRowTag = 0x08;

void AppendRow(int row, std::string& out) {
  if (row == 0) return;  // a zero isn't written
  out.push_back(kRowTag);
  uint32_t rest = static_cast<uint32_t>(row);
  for (; rest >= 0x80; rest >>= 7) out.push_back(static_cast<char>(rest | 0x80));
  out.push_back(static_cast<char>(rest));
}

// How long the row is that `bytes` begin with.
size_t RowBytes(std::string_view bytes) {
  if (bytes.empty() || bytes[0] != kRowTag) return 0;
  size_t end = 1;
  while (static_cast<unsigned char>(bytes[end]) >= 0x80) ++end;
  return end + 1;
}

}  // namespace

ReadingBatch::ReadingBatch(const google::protobuf::RepeatedPtrField<v1::Reading>& readings) {
  ends_.reserve(readings.size());
  rows_.reserve(readings.size());
  for (const v1::Reading& reading : readings) {
    rows_.push_back(reading.row());
    if (!reading.has_server_time()) {
      Add(reading);
      continue;
    }
    v1::Reading without = reading;
    without.clear_server_time();
    Add(without);
  }
}

void ReadingBatch::Add(const v1::Reading& reading) {
  const size_t begin = bytes_.size();
  reading.AppendPartialToString(&bytes_);
  bytes_.erase(begin, RowBytes(std::string_view(bytes_).substr(begin)));
  ends_.push_back(bytes_.size());
}

const std::string& ReadingBatch::Encoded(int i, int row, std::string& buffer) const {
  const size_t begin = i == 0 ? 0 : ends_[i - 1];
  buffer.clear();
  AppendRow(row, buffer);
  buffer.append(bytes_, begin, ends_[i] - begin);
  return buffer;
}

}  // namespace truepose::store
