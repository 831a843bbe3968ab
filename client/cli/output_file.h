// A file that is there whole or not at all.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/strings/string_view.h"

namespace truepose::cli {

// Writes beside the target and renames, so that a run that fails, or is killed, leaves an older
// file as it was. Made before a long run, it also tells at once that the place can't be written to.
class OutputFile {
 public:
  // @param option the option that named the file, for the fault: "--output".
  // kInvalidArgument with a fault when no file can be made there.
  static absl::StatusOr<OutputFile> Create(std::string path, std::string option);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  // Without a Commit, removes what was begun.
  ~OutputFile();

  // Writes all of `text` and puts it in place. Once only. On failure nothing is left of it.
  absl::Status Commit(absl::string_view text);

 private:
  OutputFile(std::string path, std::string option, std::string temporary, int descriptor);
  absl::Status FaultOf(absl::string_view what) const;

  std::string path_;
  std::string option_;
  std::string temporary_;  // "" when path is a device or a pipe, which is written directly
  int descriptor_ = -1;    // -1: done or moved from
};

}  // namespace truepose::cli
