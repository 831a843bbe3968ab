// What a server released for a robot: the table of the calibration that acts on it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "absl/status/statusor.h"

namespace truepose::agent {

struct ReleasedEntry {
  std::string table = {};        // robots/{robot}/compensationTables/{uuid}
  std::string sha256 = {};       // of the file's bytes, lower-case hex
  std::string calibration = {};  // robots/{robot}/calibrations/{number}
  std::string calibration_digest = {}, nominal_digest = {};  // lower-case hex
  std::string serial = {};                                   // of the arm; "" = not known
  // When the server made the calibration the active one, by its clock, us since 1970; and the
  // commit that did it.
  int64_t activated_us = 0, revision = 0;

  bool operator==(const ReleasedEntry&) const = default;
};

// 64 digits of lower-case hex: what may become a file's name.
bool IsDigest(const std::string& text);

// Whether `offered` was made active before `running` by time and by commit: what a server says that
// was restored from an older copy. A calibration that is rolled back to is made active anew, so it
// is not older. Of one calibration none is older.
bool IsOlder(const ReleasedEntry& offered, const ReleasedEntry& running);

// A JSON object with `robot` and `sets`, in their order.
std::string ToJson(const std::string& robot, const std::vector<ReleasedEntry>& sets);
// The reverse. @returns kInvalidArgument for what is no such text, kFailedPrecondition when it is
// another robot's.
absl::StatusOr<std::vector<ReleasedEntry>> EntriesFromJson(const std::string& text,
                                                           const std::string& robot);

// "calibrations/3" of robots/arm/calibrations/3: for lines that name the robot already.
std::string ShortName(const std::string& name);

// "2026-03-01T14:05:09Z"
std::string TimeText(int64_t time_us);

}  // namespace truepose::agent
