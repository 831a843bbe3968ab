// Compensation tables for jobs, RPCs and `--local`: messages in, a file's bytes out.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "convert/run.h"
#include "truepose/v1/compensation_table.pb.h"

namespace truepose::convert {

struct TableFile {
  std::string bytes;                   // docs/formats.md
  v1::CompensationTableHeader header;  // what stands in them, and what only building tells
};

// Builds and verifies the table of a calibration. Equal inputs give equal bytes: the time that
// stands in the file is the calibration's, or none.
// @returns kInvalidArgument with faults of nominal, calibration and spec (`joint_ranges...`,
//   `box...`); kFailedPrecondition with faults for a calibration whose verdict is do_not_apply, a
//   domain that is not reached and a file that would be too large; kCancelled.
absl::StatusOr<TableFile> RunTableBuild(const v1::CompensationTableInput& input,
                                        const RunHooks& hooks = {});

// What RunTableBuild would build, in a fraction of its time. @returns the errors of RunTableBuild.
absl::StatusOr<v1::CompensationTableEstimate> RunTableEstimate(
    const v1::CompensationTableInput& input);

}  // namespace truepose::convert
