// truepose reproduce: our figures beside the chapter's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/run.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Would catch degrees taken for radians, and a relation that is printed but not computed.
TEST(Reproduce, Table2TakesDegreesAndMillimetres) {
  const Ran ran = RunCli({"reproduce", "table2", "--q-deg", "30", "--l-mm", "100"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("dbeta_i        0.0500  -0.0866"));
  EXPECT_THAT(ran.out, HasSubstr("one of dq_i, dbeta_i, db_{i+1} is redundant"));
  EXPECT_EQ(At(OneObject(RunCli({"reproduce", "table2", "--json"}).out), "columns.4.parameter"),
            "dq_i");
  EXPECT_EQ(RunCli({"reproduce", "table2", "--l-mm", "inf"}).code, 3);
}

TEST(Reproduce, Table3FindsThePrintedNames) {
  const Ran ran = RunCli({"reproduce", "table3"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("modified_incremental: 28 parameters, 16 internal"));
  EXPECT_THAT(ran.out, Not(HasSubstr("printed:")));
  const auto json = OneObject(RunCli({"reproduce", "table3", "--json"}).out);
  EXPECT_EQ(At(json, "models.0.internal"), "16");
}

// Would catch a printed figure beside the wrong row, metres for millimetres, and a chosen number of
// seeds that is not used.
TEST(Reproduce, Section11ShowsBothSides) {
  const Ran ran = RunCli({"reproduce", "section11", "--seeds", "1"});
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("1 simulated robot"));
  EXPECT_THAT(ran.out, ::testing::ContainsRegex("simplex +40 .* 0.310 +0.301 +0.305 +07' 33\""));
  EXPECT_THAT(ran.out, ::testing::ContainsRegex("81 +4.7[0-9]* .* 4.702 +-"));
  const auto json = OneObject(RunCli({"reproduce", "section11", "--seeds", "1", "--json"}).out);
  EXPECT_EQ(At(json, "seeds.0.fits.0.estimator"), "levenberg_marquardt");
  EXPECT_EQ(At(json, "chapter.0.calibration.mean_mm"), "4.789");
  EXPECT_EQ(RunCli({"reproduce", "section11", "--seeds", "0"}).code, 3);
}

}  // namespace
}  // namespace truepose::cli
