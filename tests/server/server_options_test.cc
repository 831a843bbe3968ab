#include "server/server_options.h"

#include "tests/server/testing/expect_status.h"

namespace truepose::server {
namespace {

using testing::HasFaultsAt;
using testing::IsOk;

TEST(ServerOptionsTest, DefaultsAreValid) { EXPECT_THAT(ServerOptions().Validate(), IsOk()); }

// Would catch an option that is not checked, or faults told one at a time.
TEST(ServerOptionsTest, EveryFaultIsNamed) {
  ServerOptions options;
  options.listen = "0.0.0.0:7878";
  options.database = "";
  options.workers = 0;
  options.handler_threads = 1000;
  options.compute_threads = -1;
  options.drain = -absl::Seconds(1);
  options.schedule = absl::ZeroDuration();
  EXPECT_THAT(options.Validate(), HasFaultsAt(std::vector<std::string>{
                                      "listen", "database", "workers", "handler_threads",
                                      "compute_threads", "drain", "schedule"}));
}

// Would catch tokens that go with the process, and two options of which one is lost.
TEST(ServerOptionsTest, WhoMayCallIsDecidedWithoutContradiction) {
  ServerOptions options;
  options.database = ":memory:";
  EXPECT_THAT(options.Validate(), HasFaultsAt(std::vector<std::string>{"database"}));
  options.dev_open = true;
  EXPECT_THAT(options.Validate(), IsOk());
  options.bootstrap = true;
  options.time_zone = "Nowhere/Land";
  EXPECT_THAT(options.Validate(), HasFaultsAt(std::vector<std::string>{"bootstrap", "time_zone"}));
  options.bootstrap = false;
  options.time_zone = "Europe/Berlin";
  EXPECT_THAT(options.Validate(), IsOk());
}

}  // namespace
}  // namespace truepose::server
