// Messages as blobs, and the little that all repositories say in the same way.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "google/protobuf/duration.pb.h"
#include "google/protobuf/message_lite.h"
#include "google/protobuf/timestamp.pb.h"
#include "server/store/sql/connection.h"

namespace truepose::store {

// @returns kDataLoss when the column doesn't hold a T.
template <typename T>
absl::StatusOr<T> ReadMessage(const sql::Statement& row, int column) {
  T message;
  if (message.ParseFromString(row.Blob(column))) return message;
  return absl::DataLossError(absl::StrCat("a stored ", message.GetTypeName(), " can't be read"));
}

// Equal messages give equal bytes.
std::string ToBlob(const google::protobuf::MessageLite& message);

google::protobuf::Timestamp ToTimestamp(absl::Time time);
absl::Duration ToDuration(const google::protobuf::Duration& duration);
absl::Time ToTime(const google::protobuf::Timestamp& timestamp);

// An entity tag of a state that was written at `revision`.
std::string ToEtag(int64_t revision);

// kNotFound with a fault whose field is `field`.
absl::Status NotFound(std::string_view name, std::string_view field = "name");
// `code` with one fault.
absl::Status Refusal(absl::StatusCode code, std::string field, std::string found,
                     std::string expected);

}  // namespace truepose::store
