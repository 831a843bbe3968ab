#include "client/agent/config/config_file.h"

#include "gmock/gmock.h"
#include "tests/server/testing/expect_status.h"

namespace truepose::agent {
namespace {

using truepose::testing::HasCode;
using truepose::testing::IsOk;

constexpr char kWhole[] = R"(agent = "cell-4"
server = "127.0.0.1:7878"
token_file = "agent.token"
spool = "/var/lib/truepose-agent"
spool_limit_mb = 64
keep_days = 14
listen = "192.168.1.5:7900"
allowed_peers = ["192.168.1.20"]
largest_clock_difference_s = 0
acknowledge = false
log_level = "debug"
[[robot]]
name = "ur10"
joints = 6
[[robot]]
name = "kuka"
joints = 7
[[source]]
kind = "csv"
robot = "kuka"
path = "/data/tracker.csv"
settle_s = 0.5
follow = true
)";

std::vector<std::string> Faults(const std::string& text) {
  std::vector<std::string> lines;
  for (const Fault& fault : FaultsOf(ParseConfig(text, "/etc/agent.toml").status()))
    lines.push_back(ToString(fault));
  return lines;
}

// Would catch a key that is read into another place, or not at all.
TEST(ConfigFileTest, EveryKey) {
  const auto config = ParseConfig(kWhole, "/etc/truepose/agent.toml");
  ASSERT_THAT(config, IsOk());
  EXPECT_EQ(config->agent, "cell-4");
  EXPECT_EQ(config->server, "127.0.0.1:7878");
  EXPECT_EQ(config->token_file, "/etc/truepose/agent.token") << "beside the file";
  EXPECT_EQ(config->spool, "/var/lib/truepose-agent");
  EXPECT_EQ(config->spool_limit_mb, 64);
  EXPECT_EQ(config->keep_days, 14);
  EXPECT_EQ(config->listen, "192.168.1.5:7900");
  EXPECT_EQ(config->allowed_peers, std::vector<std::string>{"192.168.1.20"});
  EXPECT_EQ(config->largest_clock_difference_s, 0);
  EXPECT_FALSE(config->acknowledge);
  EXPECT_EQ(config->log_level, "debug");
  ASSERT_EQ(config->robots.size(), 2u);
  EXPECT_EQ(config->robots[1].name, "robots/kuka");
  EXPECT_EQ(config->robots[1].joints, 7);
  ASSERT_EQ(config->sources.size(), 1u);
  EXPECT_EQ(config->sources[0].robot, "robots/kuka");
  EXPECT_EQ(config->sources[0].values,
            (std::map<std::string, std::string>{
                {"path", "/data/tracker.csv"}, {"settle_s", "0.5"}, {"follow", "true"}}));
}

// Would catch a person who mends one fault only to be told of the next.
TEST(ConfigFileTest, AllFaultsAtOnceWithTheirLines) {
  EXPECT_THAT(
      Faults("agent = \"Cell 4\"\nserver = \"nowhere\"\nspool_limit_mb = \"big\"\n"
             "listen = \"0.0.0.0:7900\"\ncolour = 1\nlog_level = \"loud\"\n[[robot]]\n"
             "name = \"ur10\"\njoints = 0\n[[robot]]\nname = \"ur10\"\n[[source]]\nkind = \"csv\"\n"
             "robot = \"crane\"\npaths = [1]\n"),
      ::testing::UnorderedElementsAre(
          ::testing::StartsWith("agent.toml:1: spool: found nothing"),
          ::testing::StartsWith("agent.toml:1: agent: found 'Cell 4'"),
          ::testing::StartsWith("agent.toml:2: server: "),
          ::testing::StartsWith("agent.toml:3: spool_limit_mb: found big, expected a whole number"),
          ::testing::StartsWith("agent.toml:4: listen: found '0.0.0.0:7900', which others"),
          ::testing::StartsWith("agent.toml:5: colour: found a key that is not known"),
          ::testing::StartsWith("agent.toml:6: log_level: found 'loud'"),
          ::testing::StartsWith("agent.toml:9: robot[0].joints: found 0, expected a whole number"),
          ::testing::StartsWith("agent.toml:10: robot[1].joints: found nothing"),
          ::testing::StartsWith("agent.toml:11: robot[1].name: found 'ur10' again"),
          ::testing::StartsWith("agent.toml:14: source[0].robot: found 'crane'"),
          ::testing::StartsWith("agent.toml:15: source[0].paths: found a list")));
}

// Would catch an example that nobody can start from.
TEST(ConfigFileTest, TheExampleHasNoFaults) {
  const auto config = ReadConfigFile(TRUEPOSE_SOURCE_DIR "/deploy/examples/agent.toml");
  ASSERT_THAT(config, IsOk());
  EXPECT_EQ(config->robots.size(), 1u);
}

TEST(ConfigFileTest, WhatIsNoToml) {
  EXPECT_THAT(Faults("agent = \n"), ::testing::ElementsAre(::testing::StartsWith("agent.toml:1")));
  EXPECT_THAT(ReadConfigFile("/nowhere/agent.toml"), HasCode(absl::StatusCode::kInvalidArgument));
}

}  // namespace
}  // namespace truepose::agent
