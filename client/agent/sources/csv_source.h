// A session file that grows while it is measured.
#pragma once

#include <chrono>
#include <string>

#include "client/agent/sources/csv_session.h"

namespace truepose::agent {

inline constexpr size_t kLongestLine = 64 << 10;

struct CsvSourceOptions {
  std::string path;
  CsvOptions csv;
  // Looked at so often: by time and not by the kernel's notices, which network drives don't send.
  std::chrono::milliseconds poll{200};
  // The session is sealed when no line came for so long; 0 = when another file takes the place of
  // this one. Lines that come later are not taken; the first is reported.
  std::chrono::milliseconds seal_after{0};
};

// Waits for the file, follows it, and goes on with the next one when the path is another file
// (rotation) or the file was written anew (truncation), which is reported. A stop leaves the
// session open; the next start goes on. What can't be read is reported line by line; a header that
// can't be used, and a session that the sink refuses, end that file only.
class CsvSource : public Source {
 public:
  CsvSource(CsvSourceOptions options, FaultReport report);

  std::string name() const override { return "csv " + options_.path; }
  absl::Status Run(ReadingSink& sink, const Stop& stop) override;

 private:
  const CsvSourceOptions options_;
  const FaultReport report_;
};

}  // namespace truepose::agent
