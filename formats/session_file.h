// Session files: CSV with `quantity_unit` headers (docs/formats.md) <-> readings in m and rad.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::formats {

struct SessionFileOptions {
  // Convention of the columns rx_, ry_, rz_, such as `xyz-intrinsic` (rotation.h). "" = the file's
  // Euler angles are no orientation and are kept as extra columns.
  std::string euler;
  // Columns beyond the known ones that the caller uses by name; no warning speaks of them.
  std::vector<std::string> used_columns = {};
};

struct SessionFile {
  v1::Session session;                // source (the file's name without folder) and extra_columns
  std::vector<v1::Reading> readings;  // row = index
  std::vector<std::string> warnings;  // unknown columns, rows that stood twice
};

// `nominal` gives number and types of the joints; nothing else of it is used.
// @returns kNotFound or kPermissionDenied with one fault that names the path when it can't be read;
//   kInvalidArgument with all faults of the content, each as `path:line: column`, found, expected.
absl::StatusOr<SessionFile> ReadSessionFile(const std::string& path, const v1::Nominal& nominal,
                                            const SessionFileOptions& options = {});

// The same for text in memory; `file_name` stands before the line in faults.
absl::StatusOr<SessionFile> ParseSessionFile(std::string_view text, std::string_view file_name,
                                             const v1::Nominal& nominal,
                                             const SessionFileOptions& options = {});

// CSV in m and rad that reads back bit for bit: readings, rows and extra columns. Columns that no
// reading fills are left out. Needs readings as ParseSessionFile makes them, no two of them equal
// in everything.
std::string WriteSessionFile(const v1::Nominal& nominal, const v1::Session& session,
                             const std::vector<v1::Reading>& readings);

}  // namespace truepose::formats
