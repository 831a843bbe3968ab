#include "server/store/message.h"

#include <utility>

#include "core/base/fault.h"
#include "google/protobuf/io/coded_stream.h"
#include "google/protobuf/io/zero_copy_stream_impl_lite.h"

namespace truepose::store {

std::string ToBlob(const google::protobuf::MessageLite& message) {
  std::string bytes;
  google::protobuf::io::StringOutputStream stream(&bytes);
  google::protobuf::io::CodedOutputStream coded(&stream);
  coded.SetSerializationDeterministic(true);
  message.SerializePartialToCodedStream(&coded);
  coded.Trim();
  return bytes;
}

google::protobuf::Timestamp ToTimestamp(absl::Time time) {
  google::protobuf::Timestamp timestamp;
  const int64_t seconds = absl::ToUnixSeconds(time);
  timestamp.set_seconds(seconds);
  timestamp.set_nanos(
      static_cast<int32_t>(absl::ToInt64Nanoseconds(time - absl::FromUnixSeconds(seconds))));
  return timestamp;
}

absl::Duration ToDuration(const google::protobuf::Duration& duration) {
  return absl::Seconds(duration.seconds()) + absl::Nanoseconds(duration.nanos());
}

absl::Time ToTime(const google::protobuf::Timestamp& timestamp) {
  return absl::FromUnixSeconds(timestamp.seconds()) + absl::Nanoseconds(timestamp.nanos());
}

std::string ToEtag(int64_t revision) { return absl::StrCat("\"", revision, "\""); }

absl::Status NotFound(std::string_view name, std::string_view field) {
  return Refusal(absl::StatusCode::kNotFound, std::string(field), std::string(name),
                 "the name of something stored");
}

absl::Status Refusal(absl::StatusCode code, std::string field, std::string found,
                     std::string expected) {
  FaultList faults;
  faults.Add(std::move(field), std::move(found), std::move(expected));
  return faults.ToStatus(code);
}

}  // namespace truepose::store
