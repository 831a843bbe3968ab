// The proof must find every way in which a corrected text can be wrong, so here are wrong ones.
#include "programs/proof.h"

#include <gtest/gtest.h>

#include "tests/programs/samples.h"

namespace truepose::programs {
namespace {

constexpr char kBefore[] = "movej([1,2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n";
const std::vector<Expected> kExpected = {{0, {1.5, 2, 3, 4, 5, 6}}};

absl::Status Prove(std::string_view after) {
  return ProveCorrected(kBefore, ReadProgram(kBefore, Dialect::kUrScript, 6), kExpected, after,
                        Dialect::kUrScript, 6);
}

TEST(ProofTest, TheRightTextIsProved) {
  EXPECT_TRUE(
      Prove("movej([1.50000000,2,3,4,5,6.00000000], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n").ok());
  // Within the printed precision of 8 decimals.
  EXPECT_TRUE(Prove("movej([1.500000004,2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n").ok());
}

TEST(ProofTest, EveryWrongTextIsFound) {
  for (const char* after :
       {"movej([1.50000002,2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n",  // a wrong value
        "movej([2,1.5,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n",         // another order
        "movej([1.5,2,3,4,5,6], a=2)\nmovej([0,0,0,0,0,0])\nmovej(x)\n",         // another speed
        "movej([1.5,2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0.0])\nmovej(x)\n",       // another target
        "movej([1.5,2,3,4,5,6], a=1)\r\nmovej([0,0,0,0,0,0])\nmovej(x)\n",       // a line end
        "movej([1.5,2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\nmovej(y)\n",         // a remark
        "movej([1.5,2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\n",                   // the end
        "movej([1.5,2,3,4,5], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n",           // a joint
        "movej([d2r(1.5),2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n",    // a unit
        "movel([1.5,2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n",         // a motion
        "\nmovej([1.5,2,3,4,5,6], a=1)\nmovej([0,0,0,0,0,0])\nmovej(x)\n", ""}) {
    EXPECT_EQ(Prove(after).code(), absl::StatusCode::kInternal) << after;
  }
}

}  // namespace
}  // namespace truepose::programs
