#include "tests/agent/released/release_fixture.h"

#include "absl/strings/str_cat.h"
#include "client/wait_for_job.h"
#include "tests/agent/released/released_testing.h"
#include "tests/server/testing/expect_status.h"

namespace truepose::agent::testing {

using truepose::testing::Import;
using truepose::testing::IsOk;
using truepose::testing::JobRequest;
using truepose::testing::MeasuringSession;
using truepose::testing::Uuid;

void ReleaseFixture::SetUp() {
  runner_.build_table = TestTableBuilder();
  Restart();
  const client::Client client = NewClient();
  Import(client, "arm", Uuid(1), MeasuringSession(100, 1));
  // Other rows, other parameters.
  for (const char* split : {"even-odd", "first:60"}) {
    const std::string id = Uuid(*split);
    auto request = JobRequest(id, "arm", Uuid(1));
    request.mutable_options()->set_split(split);
    ASSERT_THAT(client.CreateCalibrationJob(request), IsOk());
    const auto job = client::WaitForJob(client, absl::StrCat("jobs/", id));
    ASSERT_THAT(job, IsOk());
    v1::ApproveCalibrationRequest approve;
    approve.set_name(job->calibration());
    approve.set_reason("looked at");
    ASSERT_THAT(client.ApproveCalibration(approve), IsOk());
  }
  v1::UpdateRobotRequest update;
  update.mutable_robot()->set_name("robots/arm");
  update.mutable_robot()->mutable_table_spec()->set_seed(3);
  update.mutable_update_mask()->add_paths("table_spec");
  v1::Robot robot;
  ASSERT_THAT(client.CallMethod("truepose.v1.RobotService/UpdateRobot", update, &robot), IsOk());
}

void ReleaseFixture::Activate(int number) const {
  v1::ActivateCalibrationRequest activate;
  activate.set_name(absl::StrCat("robots/arm/calibrations/", number));
  ASSERT_THAT(NewClient().ActivateCalibration(activate), IsOk());
}

void ReleaseFixture::RollBack() const {
  v1::RollBackCalibrationRequest back;
  back.set_robot("robots/arm");
  back.set_reason("it was better");
  ASSERT_THAT(NewClient().RollBackCalibration(back), IsOk());
}

}  // namespace truepose::agent::testing
