// Several robots and clients at once.
#include <set>
#include <thread>
#include <vector>

#include "absl/strings/str_cat.h"
#include "client/append_readings.h"
#include "client/wait_for_job.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"

namespace truepose {
namespace {

using testing::Import;
using testing::IsOk;
using testing::JobRequest;
using testing::MeasuringSession;
using testing::Uuid;

class ConcurrencyTest : public testing::ServerFixture {};

// Runs `work(i)` in a thread each and waits for all.
template <typename Work>
void InParallel(int count, const Work& work) {
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back([&work, i] { work(i); });
  for (std::thread& thread : threads) thread.join();
}

// Would catch readings, jobs or results that get to another robot, and numbers given twice.
TEST_F(ConcurrencyTest, RobotsDoNotMix) {
  constexpr int kRobots = 6;
  std::vector<std::string> digests(kRobots);
  InParallel(kRobots, [&](int i) {
    const client::Client client = NewClient();
    const std::string robot = absl::StrCat("arm-", i);
    ASSERT_NO_FATAL_FAILURE(Import(client, robot, Uuid(i), MeasuringSession(40 + i, i)));
    ASSERT_THAT(client.CreateCalibrationJob(JobRequest(Uuid(100 + i), robot, Uuid(i))), IsOk());
    const auto job = client::WaitForJob(client, absl::StrCat("jobs/", Uuid(100 + i)));
    ASSERT_THAT(job, IsOk());
    ASSERT_EQ(job->calibration(), absl::StrCat("robots/", robot, "/calibrations/1"));
    v1::GetCalibrationRequest request;
    request.set_name(job->calibration());
    const auto calibration = client.GetCalibration(request);
    ASSERT_THAT(calibration, IsOk());
    EXPECT_EQ(calibration->report().sets().complete().poses(), 40 + i);
    digests[i] = calibration->digest();
  });
  EXPECT_EQ(std::set<std::string>(digests.begin(), digests.end()).size(), size_t{kRobots});
}

// Would catch a session that two uploads of the same file fill twice or mix: the second only
// repeats.
TEST_F(ConcurrencyTest, TwoUploadsOfOneSessionMakeOne) {
  const client::Client client = NewClient();
  const auto input = MeasuringSession(400, 1);
  const std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
  Import(client, "arm", Uuid(1), MeasuringSession(5, 1));
  v1::CreateSessionRequest session;
  session.set_session_id(Uuid(2));
  session.mutable_session()->set_robot("robots/arm");
  ASSERT_THAT(client.CreateSession(session), IsOk());
  InParallel(4, [&](int) {
    const auto count = client::AppendReadings(NewClient(), absl::StrCat("sessions/", Uuid(2)),
                                              readings, {.batch_size = 7});
    EXPECT_THAT(count, IsOk());
  });
  v1::GetSessionRequest request;
  request.set_name(absl::StrCat("sessions/", Uuid(2)));
  EXPECT_EQ(client.GetSession(request)->reading_count(), 400);
}

// Would catch a race between creates of the same thing: all get the same answer, and there is one
// robot.
TEST_F(ConcurrencyTest, CreatesOfTheSameRobotMakeOne) {
  v1::CreateRobotRequest robot;
  robot.set_robot_id("arm");
  *robot.mutable_nominal() = convert::MeasuringRobot();
  std::vector<std::string> answers(8);
  InParallel(8, [&](int i) {
    const auto created = NewClient().CreateRobot(robot);
    ASSERT_THAT(created, IsOk());
    answers[i] = created->SerializeAsString();
  });
  EXPECT_EQ(std::set<std::string>(answers.begin(), answers.end()).size(), 1u);
}

}  // namespace
}  // namespace truepose
