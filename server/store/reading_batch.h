// Readings as the store keeps them, encoded before they get to the one thread that writes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "google/protobuf/repeated_field.h"
#include "truepose/v1/session.pb.h"

namespace truepose::store {

// A stored reading is the message's bytes with its row and without server_time, which stands beside
// it. Equal readings have equal bytes, so a repeat is told from another reading by comparing them.
class ReadingBatch {
 public:
  ReadingBatch() = default;
  explicit ReadingBatch(const google::protobuf::RepeatedPtrField<v1::Reading>& readings);

  int size() const { return static_cast<int>(rows_.size()); }
  bool empty() const { return rows_.empty(); }
  // The row that reading i came with.
  int row(int i) const { return rows_[i]; }
  // The bytes of reading i in `row`, which is not negative; put together in `buffer`.
  const std::string& Encoded(int i, int row, std::string& buffer) const;

 private:
  void Add(const v1::Reading& reading);

  std::string bytes_;         // of all readings, without their rows
  std::vector<size_t> ends_;  // of each in bytes_
  std::vector<int> rows_;
};

}  // namespace truepose::store
