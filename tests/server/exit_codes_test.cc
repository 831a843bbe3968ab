#include "server/exit_codes.h"

#include "client/exit_codes.h"
#include "gtest/gtest.h"

namespace truepose {
namespace {

// Would catch a number that means one thing to a script with trueposed and another with truepose.
TEST(ExitCodesTest, ServerAndClientAgree) {
  EXPECT_EQ(int{server::kExitOk}, int{client::kExitOk});
  EXPECT_EQ(int{server::kExitRunFailed}, int{client::kExitRunFailed});
  EXPECT_EQ(int{server::kExitUsage}, int{client::kExitUsage});
  EXPECT_EQ(int{server::kExitInput}, int{client::kExitInput});
  EXPECT_EQ(int{server::kExitUnavailable}, int{client::kExitUnavailable});
  EXPECT_EQ(int{server::kExitDatabase}, int{client::kExitDatabase});
  EXPECT_EQ(int{server::kExitNotFound}, int{client::kExitNotFound});
  EXPECT_EQ(int{server::kExitNotAllowed}, int{client::kExitNotAllowed});
}

}  // namespace
}  // namespace truepose
