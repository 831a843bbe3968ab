// A released table that was checked and may be used.
#pragma once

#include <memory>
#include <string>

#include "absl/status/statusor.h"
#include "client/agent/released/released_entry.h"
#include "compensation/table_file.h"

namespace truepose::agent {

// Immutable; its table stays mapped as long as somebody holds it.
class ReleasedSet {
 public:
  // Maps the file `path` and checks it: whole and intact, of robot `robot` (a name, and the
  // entry's serial when there is one), of the entry's nominal robot and calibration, bytes of the
  // entry's digest. Each refusal says what was found and what was expected.
  // @returns kUnavailable when it can't be read; kDataLoss for bytes that are not the entry's,
  //   which another download may mend; kFailedPrecondition for a table that is for something else.
  static absl::StatusOr<std::shared_ptr<const ReleasedSet>> Map(const std::string& path,
                                                                const std::string& robot,
                                                                const ReleasedEntry& entry);

  const ReleasedEntry& entry() const { return entry_; }
  const compensation::Table& table() const { return file_.table(); }
  const std::string& path() const { return path_; }

 private:
  ReleasedSet(std::string path, ReleasedEntry entry) : path_(path), entry_(std::move(entry)) {}

  const std::string path_;
  const ReleasedEntry entry_;
  compensation::TableFile file_;
};

}  // namespace truepose::agent
