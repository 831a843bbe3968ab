// The watch on the command line.
#include "client/watch.h"

#include <gmock/gmock.h>

#include <thread>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/client.h"
#include "tests/cli/remote_fixture.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class WatchCommandTest : public RemoteFixture {
 protected:
  void Rename(int to) const {
    Demand({"instrument", "update", "lt-1", "--set", absl::StrCat("display_name=", to)});
  }
  // Of what there is now.
  std::string Revision() const {
    return At(OneObject(Demand({"instrument", "show", "lt-1", "--json"}).out), "revision");
  }
};

// Would catch changes that are not told, kinds or robots that are not asked for, and a --from that
// begins elsewhere.
TEST_F(WatchCommandTest, TellsWhatChanged) {
  AddRobot();
  Demand({"instrument", "create", "lt-1"});
  const std::string from = Revision();
  Import();
  Rename(1);
  const Ran all = Demand({"watch", "--from", from, "--count", "3"});
  EXPECT_THAT(all.out, HasSubstr("session"));
  EXPECT_THAT(all.out, HasSubstr("sealed"));
  EXPECT_THAT(all.out, HasSubstr("lt-1"));
  EXPECT_THAT(all.err, HasSubstr("To go on here: truepose watch --from "));
  const Ran some = Demand({"watch", "--from", from, "--count", "1", "--kind", "instrument"});
  EXPECT_THAT(some.out, Not(HasSubstr("session")));
  EXPECT_THAT(some.out, HasSubstr("lt-1"));
  const Ran json = Demand({"watch", "--from", from, "--count", "1", "--json"});
  const std::vector<std::string> lines = absl::StrSplit(json.out, '\n');
  EXPECT_EQ(At(OneObject(absl::StrCat(lines[0], "\n")), "events.0.kind"), "KIND_SESSION");
}

// Would catch options that are taken for something else, and a history that is waited for in vain.
TEST_F(WatchCommandTest, RefusesWhatThereIsNot) {
  EXPECT_EQ(Remote({"watch", "--kind", "screw"}).code, 3);
  EXPECT_EQ(Remote({"watch", "--from", "yesterday"}).code, 3);
  EXPECT_EQ(Remote({"watch", "--robot", "ur11"}).code, 6);
  const Ran future = Remote({"watch", "--from", "1000000"});
  EXPECT_EQ(future.code, 3);
  EXPECT_THAT(future.err, HasSubstr("Without --from"));
}

// Would catch a watch that ends, misses a change or tells one twice when the server is started
// again; on the library, since a command can't be told to start a server.
TEST_F(WatchCommandTest, GoesOnOverARestartOfTheServer) {
  Demand({"instrument", "create", "lt-1"});
  const auto client = client::Client::Connect(server_->address());
  ASSERT_TRUE(client.ok());
  std::vector<std::string> names;
  v1::WatchRequest request;
  request.add_kinds(v1::KIND_INSTRUMENT);
  int reconnected = 0;
  client::FollowOptions options;
  options.on_reconnect = [&](const absl::Status&) { ++reconnected; };
  const absl::Status status = client::FollowWatch(
      *client, request,
      [&](const v1::WatchResponse& response) {
        if (response.snapshot_complete()) Rename(1);
        if (response.snapshot()) return true;
        for (const v1::WatchEvent& event : response.events()) {
          names.push_back(event.instrument().display_name());
          if (names.size() == 1) {
            Rename(2);
            StartServer();
            Rename(3);
          }
        }
        return names.size() < 3;
      },
      options);
  EXPECT_TRUE(status.ok()) << status;
  EXPECT_EQ(names, (std::vector<std::string>{"1", "2", "3"}));
  EXPECT_GE(reconnected, 1);
}

}  // namespace
}  // namespace truepose::cli
