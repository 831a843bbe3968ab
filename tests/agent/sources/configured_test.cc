#include "client/agent/sources/configured.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "tests/agent/sources/fake_sink.h"
#include "tests/cli/temp_folder.h"

namespace truepose::agent {
namespace {

using ::testing::HasSubstr;

SourceSettings Settings(const std::string& kind, std::map<std::string, std::string> values) {
  SourceSettings settings;
  settings.kind = kind;
  settings.robot = "robots/r";
  settings.joints = 2;
  settings.values = std::move(values);
  return settings;
}

std::string FaultsOfMaking(const SourceSettings& settings) {
  std::string text;
  for (const Fault& fault : FaultsOf(MakeSource(settings, [](const Fault&) {}).status()))
    text += ToString(fault) + "\n";
  return text;
}

// Would catch a setting that is read and not used.
TEST(ConfiguredTest, ACsvSourceReadsAsItIsTold) {
  const cli::TempFolder folder;
  const std::string path = folder.Write(
      "a.csv", "time,q1_deg,q2_mm,x_mm\n2026-03-14T09:00:00Z,0,5,1\n2026-03-14T09:00:02Z,0,5,1\n");
  const auto source = MakeSource(Settings("csv", {{"path", path},
                                                  {"sliding", "2"},
                                                  {"still_s", "2"},
                                                  {"purpose", "check"},
                                                  {"operator", "Ada"},
                                                  {"poll_ms", "2"},
                                                  {"seal_after_s", "0.01"}}),
                                 [](const Fault& fault) { ADD_FAILURE() << ToString(fault); });
  ASSERT_TRUE(source.ok()) << source.status();
  EXPECT_EQ((*source)->name(), "csv " + path);
  FakeSink sink;
  const Stop stop;
  std::thread thread([&] { EXPECT_TRUE((*source)->Run(sink, stop).ok()); });
  EXPECT_TRUE(sink.WaitFor(
      [](const auto& sessions) { return sessions.size() == 1 && sessions[0].sealed; }));
  stop.Request();
  thread.join();
  const FakeSession session = sink.Sessions().at(0);
  ASSERT_EQ(session.readings.size(), 1u) << "one standstill";
  EXPECT_EQ(session.readings[0].joints_measured(1), 0.005);
  EXPECT_EQ(session.content.purpose(), v1::CHECK);
  EXPECT_EQ(session.content.operator_(), "Ada");
  EXPECT_EQ(session.content.robot(), "robots/r");
}

TEST(ConfiguredTest, EveryKindIsMade) {
  for (const std::string& kind : SourceKinds()) {
    auto settings = Settings(kind, {});
    if (kind != "stdin") settings.values["path"] = "/data/x";
    EXPECT_EQ(FaultsOfMaking(settings), "") << kind;
  }
}

// Would catch faults told one at a time, and keys that are taken and ignored.
TEST(ConfiguredTest, AllFaultsComeTogether) {
  const std::string faults = FaultsOfMaking(Settings("csv", {{"sliding", "3, x"},
                                                             {"still_tolerance", "0.001"},
                                                             {"poll_ms", "soon"},
                                                             {"purpose", "fun"},
                                                             {"euler", "abc"},
                                                             {"folow", "true"}}));
  for (const char* fault :
       {"path: found nothing", "sliding: found '3', expected joints from 1 to 2",
        "sliding: found 'x'", "still_tolerance: found a tolerance without a time",
        "poll_ms: found 'soon', expected a number from 0 to", "purpose: found 'fun'",
        "euler: found", "folow: found 'true', expected one of "})
    EXPECT_THAT(faults, HasSubstr(fault));
  EXPECT_THAT(FaultsOfMaking(Settings("cvs", {})),
              HasSubstr("kind: found 'cvs', expected one of csv, folder, stdin"));
}

}  // namespace
}  // namespace truepose::agent
