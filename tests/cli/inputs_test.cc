// Files that commands read, with what only the message can tell located in the file.
#include "client/cli/inputs.h"

#include "core/base/fault.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> Faults(const absl::Status& status) {
  std::vector<std::string> lines;
  for (const Fault& fault : FaultsOf(status)) lines.push_back(ToString(fault));
  return lines;
}

TEST(LoadFixture, ReadsTheExamples) {
  for (const char* name : {"sockets.yaml", "dime.yaml"}) {
    const auto fixture = LoadFixture(std::string(TRUEPOSE_SOURCE_DIR "/deploy/examples/") + name);
    ASSERT_TRUE(fixture.ok()) << fixture.status();
    EXPECT_GE(fixture->features_size(), 2);
  }
}

// Catches: a covariance that is none and that the fit meets later, without a line.
TEST(LoadFixture, NamesTheLineOfACovarianceThatIsNone) {
  const TempFolder folder;
  const std::string rows =
      ", [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], "
      "[0, 0, 0, 0, 0, 1]]\n";
  const std::string feature =
      "  - name: a\n    kind: pose\n    position_mm: [0, 0, 0]\n"
      "    covariance_mm_deg: [";
  const std::string path = folder.Write(
      "f.yaml", "name: f\nfeatures:\n" + feature + "[1, 2, 0, 0, 0, 0], [2, 1, 0, 0, 0, 0]" + rows +
                    "  - name: b\n    kind: pose\n    position_mm: [0, 0, 0]\n"
                    "    covariance_mm_deg: [[1, 0, 0, 0, 0, 0], [1, 1, 0, 0, 0, 0]" +
                    rows);
  EXPECT_THAT(
      Faults(LoadFixture(path).status()),
      ElementsAre(path + ":6: features[0].covariance: found an eigenvalue of -1 (scaled), expected "
                         "a covariance: positive semidefinite",
                  path + ":10: features[1].covariance: found a matrix that is not symmetric, "
                         "expected a covariance"));
}

TEST(LoadFixture, AMissingFileIsAFaultOfTheInput) {
  EXPECT_EQ(LoadFixture("no/such.yaml").status().code(), absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace truepose::cli
