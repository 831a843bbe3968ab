#include "core/calibrate/scope.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using ::testing::HasSubstr;

class ScopeTest : public ::testing::Test {
 protected:
  std::vector<std::string> Free(const std::string& text) {
    const auto scope = ScopeOf(text, problem_);
    EXPECT_TRUE(scope.ok()) << scope.status();
    std::vector<std::string> names;
    const ParameterSet all = Candidates(problem_);
    for (int candidate : scope->free) {
      if (candidate >= problem_.FirstInternal()) names.push_back(all[candidate].name);
    }
    frames_ = static_cast<int>(scope->free.size() - names.size());
    return names;
  }

  const Model model_ = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  const Problem problem_{&model_, {}, {""}, {""}};
  int frames_ = 0;
};

TEST_F(ScopeTest, Words) {
  EXPECT_TRUE(Free("").empty());
  EXPECT_EQ(frames_, 0) << "empty means everything";
  EXPECT_TRUE(Free("all").empty());
  EXPECT_TRUE(Free("internal").empty());
  EXPECT_TRUE(Free("external").empty());
  EXPECT_EQ(frames_, 12);
  EXPECT_TRUE(Free("base").empty());
  EXPECT_EQ(frames_, 6);
  EXPECT_EQ(Free("joint_offsets").size(), 6u);
  EXPECT_THAT(Free("dq3, dalpha4"), ::testing::ElementsAre("dq3", "dalpha4"));
  EXPECT_EQ(frames_, 12);
}

TEST_F(ScopeTest, EveryUnknownNameIsAFault) {
  const auto scope = ScopeOf("dq3,dq9,elbow", problem_);
  ASSERT_FALSE(scope.ok());
  EXPECT_THAT(std::string(scope.status().message()), HasSubstr("'dq9'"));
  EXPECT_THAT(std::string(scope.status().message()), HasSubstr("'elbow'"));
  EXPECT_THAT(std::string(scope.status().message()), HasSubstr("joint_offsets"));
}

}  // namespace
}  // namespace truepose
