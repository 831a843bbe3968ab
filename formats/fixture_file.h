// Fixture files: YAML with units in the key names (docs/formats.md) <-> v1::Fixture in m and rad.
//
// Checked here is what the text can tell: keys, kinds, units, counts, names. Whether a covariance
// is one is checked by convert::ValidateFixture; LocateFaults(status, file.lines) gives its faults
// the lines of the file.
#pragma once

#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "formats/field_lines.h"
#include "truepose/v1/fixture.pb.h"

namespace truepose::formats {

struct FixtureFile {
  v1::Fixture fixture;
  FieldLines lines;  // of the fields of `fixture`
};

// @returns kNotFound or kPermissionDenied with one fault that names the path when it can't be read;
//   kInvalidArgument with all faults of the content, each as `path:line: field`, found, expected.
absl::StatusOr<FixtureFile> ReadFixtureFile(const std::string& path);

// The same for text in memory; `file_name` stands before the line in faults.
absl::StatusOr<FixtureFile> ParseFixtureFile(std::string_view text, std::string_view file_name);

// YAML that reads back as an equal message, bit for bit: in mm and deg where these digits give the
// same bits, else in m and rad. Needs a fixture as ParseFixtureFile makes them (unit quaternions
// with qw >= 0, known kinds, 36 numbers of a covariance or none).
std::string WriteFixtureFile(const v1::Fixture& fixture);

}  // namespace truepose::formats
