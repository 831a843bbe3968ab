#include "client/pager.h"

#include <string>
#include <vector>

#include "gtest/gtest.h"
#include "truepose/v1/services.pb.h"

namespace truepose::client {
namespace {

using Reply = absl::StatusOr<v1::ListRobotsResponse>;

Reply Page(const std::string& robot, const std::string& next) {
  v1::ListRobotsResponse page;
  page.add_robots()->set_name(robot);
  page.set_next_page_token(next);
  return page;
}

// Walks `list` and gathers the names it saw.
absl::Status Walk(const std::function<Reply(const v1::ListRobotsRequest&)>& list,
                  std::vector<std::string>* names) {
  return ForEachPage(v1::ListRobotsRequest(), list, [&](const v1::ListRobotsResponse& page) {
    names->push_back(page.robots(0).name());
    return absl::OkStatus();
  });
}

// Would catch a list that ends after its first page, or skips the last.
TEST(PagerTest, WalksAllPages) {
  std::vector<std::string> names;
  const auto list = [](const v1::ListRobotsRequest& request) {
    if (request.page_token().empty()) return Page("a", "1");
    return request.page_token() == "1" ? Page("b", "2") : Page("c", "");
  };
  EXPECT_TRUE(Walk(list, &names).ok());
  EXPECT_EQ(names, (std::vector<std::string>{"a", "b", "c"}));
}

// Would catch a faulty server that keeps a client for ever.
TEST(PagerTest, ATokenThatStaysIsAnError) {
  std::vector<std::string> names;
  const auto list = [](const v1::ListRobotsRequest&) { return Page("a", "1"); };
  EXPECT_TRUE(absl::IsInternal(Walk(list, &names)));
  EXPECT_EQ(names.size(), 2u);
}

TEST(PagerTest, AFailedPageEndsTheWalk) {
  std::vector<std::string> names;
  const auto list = [](const v1::ListRobotsRequest& request) -> Reply {
    if (request.page_token().empty()) return Page("a", "1");
    return absl::UnavailableError("gone");
  };
  EXPECT_TRUE(absl::IsUnavailable(Walk(list, &names)));
}

TEST(PagerTest, TheCallerMayEndTheWalk) {
  const auto list = [](const v1::ListRobotsRequest&) { return Page("a", "1"); };
  const auto stop = [](const v1::ListRobotsResponse&) { return absl::CancelledError("enough"); };
  EXPECT_TRUE(absl::IsCancelled(ForEachPage(v1::ListRobotsRequest(), list, stop)));
}

}  // namespace
}  // namespace truepose::client
