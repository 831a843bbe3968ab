// Any resource of the API as YAML or JSON, read by the message's descriptor.
//
// Keys are the fields' names. A field in m or rad (`position_sd_m`, `rotation_sd_rad`) may as well
// be given in mm or deg (`position_sd_mm`). Enums are written by their names, times in RFC 3339,
// durations as "90s". A pose without qx, qy, qz, qw has no rotation. `~` or nothing as value is the
// empty field, which an update clears.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "absl/status/status.h"
#include "google/protobuf/message.h"

namespace truepose::formats {

// Which fields of a message a text has given.
struct GivenFields {
  // As paths of a field mask: `serial`, `limits.drift_rms_mm`; poses and lists as a whole.
  std::vector<std::string> paths;
  // Those of them that were written in m or rad, and not in mm or deg.
  std::vector<std::string> in_si;
};

// Sets the fields of `message` that the file gives and adds their paths to `given`.
// @returns kNotFound or kPermissionDenied with one fault that names the path when it can't be read;
//   kInvalidArgument with all faults of the content, each as `path:line: field`, found, expected;
//   `message` is unspecified then.
absl::Status ReadMessageFile(const std::string& path, google::protobuf::Message& message,
                             GivenFields& given);
// The same for text in memory; `file_name` stands before the line in faults.
absl::Status ParseMessageFile(std::string_view text, std::string_view file_name,
                              google::protobuf::Message& message, GivenFields& given);

// The same for fields given one by one: {"limits.drift_rms_mm", "0.3"}, {"serial", ""}. Lists can't
// be given so. @param option stands before the field in faults.
absl::Status SetMessageFields(const std::vector<std::pair<std::string, std::string>>& fields,
                              std::string_view option, google::protobuf::Message& message,
                              GivenFields& given);

}  // namespace truepose::formats
