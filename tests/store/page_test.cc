#include "server/store/page.h"

#include <gtest/gtest.h>

namespace truepose::store {
namespace {

const ListId kJobs{"jobs", "ur10"};

// Catches a page that is larger than allowed, and a default that isn't used.
TEST(Page, SizesAreBounded) {
  EXPECT_EQ(CheckPage(kJobs, {})->size, 100);
  EXPECT_EQ(CheckPage(kJobs, {.size = 7, .token = ""})->size, 7);
  EXPECT_EQ(CheckPage(kJobs, {.size = 1 << 30, .token = ""})->size, 1000);
  EXPECT_EQ(CheckPage(kJobs, {}, {.default_size = 3, .max_size = 5})->size, 3);
  EXPECT_FALSE(CheckPage(kJobs, {.size = -1, .token = ""}).ok());
}

// Catches a token that loses its key, or that another list or filter takes.
TEST(Page, ATokenIsOfOneListWithOneFilter) {
  const PageRequest request{.size = 0, .token = MakePageToken(kJobs, "17")};
  EXPECT_EQ(CheckPage(kJobs, request)->after, "17");
  EXPECT_EQ(*AfterNumber(*CheckPage(kJobs, request), 0), 17);
  EXPECT_FALSE(CheckPage({"jobs", "panda"}, request).ok());
  EXPECT_FALSE(CheckPage({"sessions", "ur10"}, request).ok());
}

// Catches a forged token that reaches the database.
TEST(Page, AKeyThatIsNoNumberIsRefused) {
  const auto start = CheckPage(kJobs, {.size = 0, .token = MakePageToken(kJobs, "seventeen")});
  ASSERT_TRUE(start.ok());
  EXPECT_EQ(AfterNumber(*start, 0).status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_FALSE(CheckPage(kJobs, {.size = 0, .token = MakePageToken(kJobs, "")}).ok())
      << "would start all over";
}

}  // namespace
}  // namespace truepose::store
