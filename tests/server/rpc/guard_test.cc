#include "server/rpc/guard.h"

#include <stdexcept>

#include "absl/status/statusor.h"
#include "gtest/gtest.h"

namespace truepose::rpc {
namespace {

// Would catch a library's exception that ends the whole server.
TEST(GuardTest, ExceptionsBecomeInternal) {
  const auto result =
      Guarded([]() -> absl::StatusOr<int> { throw std::runtime_error("no memory"); });
  EXPECT_EQ(result.status().code(), absl::StatusCode::kInternal);
  EXPECT_NE(result.status().message().find("no memory"), absl::string_view::npos);
}

TEST(GuardTest, ResultsPassAsTheyAre) {
  EXPECT_EQ(*Guarded([]() -> absl::StatusOr<int> { return 7; }), 7);
  EXPECT_TRUE(absl::IsAborted(
      Guarded([]() -> absl::StatusOr<int> { return absl::AbortedError("x"); }).status()));
}

}  // namespace
}  // namespace truepose::rpc
