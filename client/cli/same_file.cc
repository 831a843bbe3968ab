#include "client/cli/same_file.h"

#include <sys/stat.h>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"

namespace truepose::cli {

absl::Status CheckOtherFile(const std::string& input, const std::string& output,
                            const std::string& option) {
  struct stat in, out;
  if (stat(input.c_str(), &in) != 0 || stat(output.c_str(), &out) != 0) return absl::OkStatus();
  if (in.st_dev != out.st_dev || in.st_ino != out.st_ino) return absl::OkStatus();
  return FaultStatus(option, absl::StrCat(output, ", which is ", input, " itself"),
                     "another file: nothing is written over the input");
}

}  // namespace truepose::cli
