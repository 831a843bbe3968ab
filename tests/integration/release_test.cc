// Release over a real server and a real calibration.
#include <grpcpp/grpcpp.h>

#include "absl/strings/str_cat.h"
#include "client/wait_for_job.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"
#include "truepose/v1/services.grpc.pb.h"

namespace truepose {
namespace {

using testing::Import;
using testing::IsOk;
using testing::JobRequest;
using testing::MeasuringSession;
using testing::Uuid;

class ReleaseOverServer : public testing::ServerFixture {
 protected:
  void SetPolicy(double most_control_rms_mm) {
    v1::UpdateRobotRequest request;
    request.mutable_robot()->set_name("robots/arm");
    request.mutable_robot()->set_release_policy(v1::AUTOMATIC_WITHIN_LIMITS);
    request.mutable_robot()->mutable_limits()->set_control_rms_mm(most_control_rms_mm);
    grpc::ClientContext context;
    v1::Robot reply;
    const auto stub = v1::RobotService::NewStub(
        grpc::CreateChannel(options_.listen, grpc::InsecureChannelCredentials()));
    const grpc::Status status = stub->UpdateRobot(&context, request, &reply);
    ASSERT_TRUE(status.ok()) << status.error_message();
  }

  std::string ActiveAfterAJob() {
    const client::Client client = NewClient();
    EXPECT_THAT(client.CreateCalibrationJob(JobRequest(Uuid(7), "arm", Uuid(1))), IsOk());
    const auto job = client::WaitForJob(client, absl::StrCat("jobs/", Uuid(7)));
    EXPECT_THAT(job, IsOk());
    v1::GetRobotRequest request;
    request.set_name("robots/arm");
    return client.GetRobot(request)->active_calibration();
  }
};

// Would catch a policy that nobody acts on, and a result that becomes active in another commit than
// its job.
TEST_F(ReleaseOverServer, WithinLimitsTheServerReleases) {
  Import(NewClient(), "arm", Uuid(1), MeasuringSession(200, 1));
  SetPolicy(1'000);
  EXPECT_EQ(ActiveAfterAJob(), "robots/arm/calibrations/1");
}

TEST_F(ReleaseOverServer, BeyondItsLimitsAPersonDoes) {
  Import(NewClient(), "arm", Uuid(1), MeasuringSession(200, 1));
  SetPolicy(1e-6);
  EXPECT_EQ(ActiveAfterAJob(), "");
}

}  // namespace
}  // namespace truepose
