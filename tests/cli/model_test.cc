#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/models/build_model.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// Would catch kept and dropped exchanged, a link without its joint, and counts of another model.
TEST(Model, ShowsLinksCountsAndRedundancies) {
  const Ran ran = RunCli({"model", Example("ur10.yaml"), "--model", "extended_dh"});
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, StartsWith("Model extended_dh of ur10: 33 candidates, 30 identifiable"));
  EXPECT_THAT(ran.out, HasSubstr("base.x base.y base.z base.rx base.ry base.rz"));
  EXPECT_THAT(ran.out, HasSubstr("\n  2 (joint "));
  EXPECT_THAT(ran.out, HasSubstr(")  dq2 dl2 dphi2 dbeta2\n"));
  EXPECT_THAT(ran.out, HasSubstr("complete, 4R + 2P + 6          30            30"));
  EXPECT_THAT(ran.out, HasSubstr("internal, 4R + 2P - 6          18            18"));
  EXPECT_THAT(ran.out, HasSubstr("  dq1 = a motion of the base frame: dropped dq1\n"));
}

// Would catch a URDF chain whose ends can't be said here as they can to the other commands.
TEST(Model, TakesTheEndsOfAUrdf) {
  const TempFolder folder;
  const std::string urdf = folder.Path("ur10.urdf");
  ASSERT_EQ(
      RunCli({"robot", "export", Example("ur10.yaml"), "--local", "--format", "urdf", "-o", urdf})
          .code,
      0);
  const Ran whole = RunCli({"model", urdf, "--json"});
  ASSERT_EQ(whole.code, 0) << whole.err;
  const Ran unknown = RunCli({"model", urdf, "--urdf-tip", "nowhere"});
  EXPECT_EQ(unknown.code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("nowhere"));
}

// Would catch a kind that the command knows and the core does not, and the other way round.
TEST(Model, EveryKindAsJson) {
  for (const std::string& kind : ModelKinds()) {
    const Ran ran = RunCli({"model", Example("franka_panda.yaml"), "--model", kind, "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto description = OneObject(ran.out);
    EXPECT_EQ(At(description, "model"), kind);
    EXPECT_THAT(At(description, "convention"), StartsWith(kind + "/"));
    EXPECT_EQ(At(description, "counts.generic_rank"), "34");
    EXPECT_EQ(At(description, "parameters.0.name"), "base.x");
    EXPECT_EQ(At(description, "redundancies.0.structural"), "true");
    EXPECT_THAT(RunCli({"model", "--help"}).out, HasSubstr(kind));
  }
}

TEST(Model, UnknownKindIsAFaultOfTheOption) {
  const Ran ran = RunCli({"model", Example("ur10.yaml"), "--model", "dh"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("--model: found 'dh', expected one of modified_incremental"));
}

}  // namespace
}  // namespace truepose::cli
