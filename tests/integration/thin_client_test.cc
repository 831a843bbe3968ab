// The example of client/examples as a process against a real server.
#include <stdio.h>
#include <sys/wait.h>

#include <fstream>
#include <iomanip>
#include <sstream>

#include "absl/strings/str_cat.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/examples.h"
#include "tests/server/testing/expect_status.h"
#include "truepose/v1/services.pb.h"

namespace truepose {
namespace {

using ::testing::HasSubstr;
using testing::IsOk;

constexpr int kPoses = 120;

class ThinClientTest : public testing::ServerFixture {
 protected:
  ThinClientTest() {
    v1::CreateRobotRequest robot = testing::RobotRequest("cell-3");
    robot.mutable_robot()->set_release_policy(v1::AUTOMATIC_WITHIN_LIMITS);
    robot.mutable_robot()->mutable_limits()->set_control_rms_mm(1'000);
    EXPECT_THAT(NewClient().CreateRobot(robot), IsOk());
  }

  // As a measuring program writes them; the last line is not yet whole.
  void Measure() const {
    std::ofstream file(readings_);
    file << std::setprecision(17);
    const v1::SessionInput measured = testing::SimulatedSession(kPoses, 1);
    for (const v1::Reading& reading : measured.readings()) {
      for (const double q : reading.joints_measured()) file << q << " ";
      const v1::Vector3& p = reading.position_m();
      const v1::Quaternion& o = reading.orientation();
      file << p.x() << " " << p.y() << " " << p.z() << " " << o.x() << " " << o.y() << " " << o.z()
           << " " << o.w() << "\n";
    }
    file << "0.1 0.2 0.3";
  }

  struct Ran {
    int code;
    std::string out;
  };
  Ran RunClient() const {
    const std::string line = absl::StrCat(THIN_CLIENT, " ", options_.listen, " cell-3 ", readings_,
                                          " 0.3 -1.2 1.4 0.2 0.9 -0.4 2>&1");
    FILE* const pipe = popen(line.c_str(), "r");
    std::string out;
    for (int c = fgetc(pipe); c != EOF; c = fgetc(pipe)) out.push_back(static_cast<char>(c));
    return {WEXITSTATUS(pclose(pipe)), out};
  }

  std::vector<double> Command() const {
    v1::CompensateRequest request;
    request.set_calibration("robots/cell-3/calibrations/1");
    v1::CompensationTarget& target = *request.add_targets();
    for (const double q : {0.3, -1.2, 1.4, 0.2, 0.9, -0.4}) target.add_joints(q);
    const auto response = NewClient().Compensate(request);
    EXPECT_THAT(response, IsOk());
    if (!response.ok()) return {};
    const auto& joints = response->targets(0).joints();
    return {joints.begin(), joints.end()};
  }

  const testing::TempDir files_;
  const std::string readings_ = files_.File("readings.txt");
};

// Would catch an example that does not work as it is printed, that leaves out a reading, or that
// commands other joints than the server says.
TEST_F(ThinClientTest, MeasuresCalibratesAndAsksForTheCommand) {
  Measure();
  const Ran ran = RunClient();
  ASSERT_EQ(ran.code, 0) << ran.out;
  EXPECT_THAT(ran.out, HasSubstr(absl::StrCat(kPoses, " readings are safe")));
  EXPECT_THAT(ran.out, HasSubstr("active: robots/cell-3/calibrations/1"));
  std::ostringstream command;
  for (const double q : Command()) command << " " << q;
  EXPECT_THAT(ran.out, HasSubstr(absl::StrCat("command:", command.str())));
}

// Would catch a second session, job or calibration when the program is started again, also after
// the server was.
TEST_F(ThinClientTest, StartedAgainItHasNoSecondEffect) {
  Measure();
  const Ran first = RunClient();
  ASSERT_EQ(first.code, 0) << first.out;
  Restart();
  const Ran second = RunClient();
  EXPECT_EQ(second.code, 0) << second.out;
  EXPECT_THAT(second.out, HasSubstr("calibration: robots/cell-3/calibrations/1\n"));
  const auto sessions = NewClient().ListSessions({});
  ASSERT_THAT(sessions, IsOk());
  ASSERT_EQ(sessions->sessions_size(), 1);
  EXPECT_EQ(sessions->sessions(0).reading_count(), kPoses);
  EXPECT_EQ(NewClient().ListCalibrationJobs({})->jobs_size(), 1);
}

// Would catch readings that are left out in silence because a line before them can't be read.
TEST_F(ThinClientTest, SaysWhichLineIsBad) {
  std::ofstream(readings_) << "0.1 0.2 oops\n";
  const Ran ran = RunClient();
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.out, ::testing::HasSubstr("0.1 0.2 oops"));
}

}  // namespace
}  // namespace truepose
