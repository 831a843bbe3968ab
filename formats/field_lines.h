// Where the fields of a message stood in the file that it was read from, so that a fault found
// later (by convert::ValidateNominal, by a server) can still name file and line.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "absl/status/status.h"

namespace truepose::formats {

class FieldLines {
 public:
  explicit FieldLines(std::string_view file_name = "") : file_name_(file_name) {}

  // `field` is a message path such as `joints[2].lower`. Lines count from 1. A later call replaces
  // an earlier one.
  void Set(std::string_view field, int line);

  // The line of `field`, else of the nearest enclosing field (`joints[2]`, `joints`), else 0. A
  // leading `nominal.` is ignored.
  int LineOf(std::string_view field) const;

  // "ur10.yaml:23: joints[2].lower"; without a known line "ur10.yaml: joints[2].lower".
  std::string Locate(std::string_view field) const;

 private:
  std::string file_name_;
  std::map<std::string, int, std::less<>> lines_;
};

// The same status with `file:line: ` before the field of every fault. A status without faults stays
// as it is.
absl::Status LocateFaults(const absl::Status& status, const FieldLines& lines);

}  // namespace truepose::formats
