#include "core/base/error_metadata.h"

#include <gtest/gtest.h>

#include "core/base/fault.h"

namespace truepose {
namespace {

// Catches entries that replace the faults or one another, or change the status.
TEST(ErrorMetadata, StandsBesideTheFaults) {
  const absl::Status fault = FaultStatus("row", "5", "4");
  absl::Status status = WithErrorMetadata(fault, "expected_sequence", "4");
  status = WithErrorMetadata(status, "epoch", "a=b");
  status = WithErrorMetadata(status, "expected_sequence", "17");
  EXPECT_EQ(ErrorMetadataOf(status),
            (ErrorMetadata{{"epoch", "a=b"}, {"expected_sequence", "17"}}));
  EXPECT_EQ(FaultsOf(status), FaultsOf(fault));
  EXPECT_EQ(status.code(), fault.code());
  EXPECT_EQ(status.message(), fault.message());
  EXPECT_TRUE(ErrorMetadataOf(fault).empty());
  EXPECT_TRUE(WithErrorMetadata(absl::OkStatus(), "a", "b").ok());
}

}  // namespace
}  // namespace truepose
