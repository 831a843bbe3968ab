// A folder into which whole session files are put.
#pragma once

#include <chrono>
#include <string>

#include "client/agent/sources/csv_session.h"

namespace truepose::agent {

struct FolderSourceOptions {
  std::string path;
  CsvOptions csv;
  // Looked at so often. A file is taken when size and time are the same as a look before: whoever
  // writes slower renames the file into the folder when it is whole.
  std::chrono::milliseconds poll{1000};
};

// Every file *.csv is one session, in the order of the names; hidden files (.name) are not taken.
// Files stay where they are; one that was taken already is known by the sink, also after a restart,
// and costs one reading of it. A file that changes afterwards is taken again, as the session that
// its first line tells. Faults as in CsvSource; a file that can't be used is reported once.
class FolderSource : public Source {
 public:
  FolderSource(FolderSourceOptions options, FaultReport report);

  std::string name() const override { return "folder " + options_.path; }
  absl::Status Run(ReadingSink& sink, const Stop& stop) override;

 private:
  const FolderSourceOptions options_;
  const FaultReport report_;
};

}  // namespace truepose::agent
