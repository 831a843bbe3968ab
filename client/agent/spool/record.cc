#include "client/agent/spool/record.h"

#include <array>

#include "client/agent/spool/crc32c.h"

namespace truepose::agent {
namespace {

void AppendU32(uint32_t value, std::string* out) {
  for (int shift = 0; shift < 32; shift += 8) out->push_back(static_cast<char>(value >> shift));
}

uint32_t U32(std::string_view bytes) {
  uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<uint8_t>(bytes[i]);
  return value;
}

uint32_t Checksum(std::string_view size, char kind, std::string_view payload) {
  return Crc32c(payload, Crc32c(size, Crc32c(std::string_view(&kind, 1))));
}

}  // namespace

void AppendRecord(RecordKind kind, std::string_view payload, std::string* out) {
  const size_t start = out->size();
  AppendU32(static_cast<uint32_t>(payload.size()), out);
  const std::string size = out->substr(start);
  AppendU32(Checksum(size, static_cast<char>(kind), payload), out);
  out->push_back(static_cast<char>(kind));
  out->append(payload);
}

std::optional<Record> ParseRecord(std::string_view bytes) {
  if (bytes.size() < kRecordHeader) return std::nullopt;
  const uint32_t size = U32(bytes);
  if (size > kLargestRecord || size > bytes.size() - kRecordHeader) return std::nullopt;
  const std::string_view payload = bytes.substr(kRecordHeader, size);
  const char kind = bytes[8];
  if (U32(bytes.substr(4)) != Checksum(bytes.substr(0, 4), kind, payload)) return std::nullopt;
  return Record{static_cast<RecordKind>(kind), payload};
}

bool HoldsRecord(std::string_view bytes) {
  for (; bytes.size() >= kRecordHeader; bytes.remove_prefix(1)) {
    const auto kind = static_cast<RecordKind>(bytes[8]);
    // Most places are none by their kind, and need no checksum.
    if (kind < RecordKind::kBegin || kind > RecordKind::kSeal) continue;
    if (ParseRecord(bytes).has_value()) return true;
  }
  return false;
}

}  // namespace truepose::agent
