// Why a file is no compensation table that can be used, as one fault.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "compensation/table_report.h"

namespace truepose::cli {

// "ur10.tpct: truncated: found 700 bytes, expected 8192".
// @param path of the file, as the report may name it; @param place what stands before the fault.
absl::Status TableFaultStatus(const compensation::TableReport& report, const std::string& path,
                              const std::string& place);

}  // namespace truepose::cli
