// The measuring robot is written twice, in code for `simulate` and in an example file: they are the
// same robot.
#include <gtest/gtest.h>

#include "convert/run.h"
#include "formats/robot_file.h"

namespace truepose::convert {
namespace {

TEST(MeasuringRobot, ExampleFileIsTheSame) {
  const auto file =
      formats::ReadRobotFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/measuring_robot.yaml");
  ASSERT_TRUE(file.ok()) << file.status();
  EXPECT_EQ(NominalDigest(file->nominal), NominalDigest(MeasuringRobot()));
}

}  // namespace
}  // namespace truepose::convert
