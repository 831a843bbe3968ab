// A record of a spool file: u32 size of the payload, u32 CRC-32C of kind, size and payload, u8
// kind, payload; little endian.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace truepose::agent {

enum class RecordKind : uint8_t {
  kBegin = 1,    // v1::Session, with its name
  kRequest = 2,  // name of the recalibration request that the session answers
  kReading = 3,  // v1::Reading; the n-th of a file is number n
  kSeal = 4,     // nothing; the last record
};

inline constexpr size_t kRecordHeader = 9;
// Of a payload; a longer one is taken for damage, not for memory to be had.
inline constexpr size_t kLargestRecord = 1 << 20;

void AppendRecord(RecordKind kind, std::string_view payload, std::string* out);

struct Record {
  RecordKind kind;
  std::string_view payload;  // within the bytes that were parsed

  size_t size() const { return kRecordHeader + payload.size(); }
};

// The record that `bytes` begin with; none when it is not whole or its checksum differs.
std::optional<Record> ParseRecord(std::string_view bytes);

// Whether a whole record of a known kind begins anywhere in `bytes`.
bool HoldsRecord(std::string_view bytes);

}  // namespace truepose::agent
