// Whole agents beside a server: the example client, what an agent says of itself.
#include "tests/agent/testing/plant.h"

#include <sys/wait.h>

#include <cstdio>
#include <fstream>
#include <thread>

#include "absl/strings/str_cat.h"
#include "gmock/gmock.h"

namespace truepose {
namespace {

constexpr int kReadings = 200;

struct Ran {
  int code = -1;
  std::string out;
};

Ran RunClient(const testing::Plant& plant, const std::string& file) {
  const std::string line =
      absl::StrCat("python3 -B " TRUEPOSE_SOURCE_DIR "/client/agent/examples/agent_client.py ",
                   plant.agent_address(), " arm ", file, " 2>&1");
  FILE* const pipe = popen(line.c_str(), "r");
  std::string out;
  for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) out.push_back(static_cast<char>(c));
  return {WEXITSTATUS(pclose(pipe)), out};
}

// Would catch an example that loses or doubles a reading, or that can't be started twice.
TEST(AgentExamplesTest, ThePythonClientGoesOnThroughAKill) {
  testing::TempDir folder;
  const std::string file = folder.File("readings.csv");
  {
    std::ofstream out(file);
    for (int number = 1; number <= kReadings; ++number)
      out << "0,10,20,30,40,50," << 1e-3 * number << ",0,0\n";
  }
  testing::Plant plant(1);
  plant.StartAgent("127.0.0.1:" + std::to_string(testing::FreePort()));
  Ran first;
  std::thread client([&] { first = RunClient(plant, file); });
  // In this thread: an agent ends with the one that started it.
  while (!std::filesystem::exists(file + ".id"))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  plant.agent().Kill();
  plant.StartAgent(plant.listen());
  client.join();
  EXPECT_EQ(first.code, 0) << first.out;
  EXPECT_THAT(first.out, ::testing::HasSubstr("200 readings are safe in sessions/"));
  EXPECT_EQ(RunClient(plant, file).code, 0) << "a second start finds that all is done";
  std::string id;
  std::ifstream(file + ".id") >> id;
  ASSERT_TRUE(plant.WaitUntilSealed({id}));
  std::vector<int64_t> expected;
  for (int64_t number = 1; number <= kReadings; ++number) expected.push_back(number);
  EXPECT_EQ(plant.Stored(id), expected);
}

// Would catch a joint count that the server refuses, and of which nobody is told before.
TEST(AgentPlantTest, AnotherJointCountThanTheServersIsSaid) {
  testing::Plant plant(1);
  plant.StartAgent("127.0.0.1:0", 7);
  EXPECT_TRUE(plant.WaitForStatus([](const nlohmann::json& status) {
    return status.at("robots")[0].at("fault") ==
           "robots/arm has 6 joints on the server; the configuration says 7";
  })) << plant.agent().Output();
}

// Would catch agents that nobody at the plant sees, or whose waiting readings are not told.
TEST(AgentPlantTest, ReportsItself) {
  testing::Plant plant(1);
  plant.StartAgent();
  const client::Client client = plant.NewClient();
  v1::ListAgentReportsResponse reports;
  for (int attempt = 0; attempt < 6'000 && reports.agent_reports().empty(); ++attempt) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_TRUE(client
                    .CallMethod("truepose.v1.RecalibrationService/ListAgentReports",
                                v1::ListAgentReportsRequest(), &reports)
                    .ok());
  }
  ASSERT_EQ(reports.agent_reports_size(), 1);
  EXPECT_EQ(reports.agent_reports(0).name(), "agentReports/cell");
  EXPECT_EQ(reports.agent_reports(0).robot(), "robots/arm");
}

}  // namespace
}  // namespace truepose
