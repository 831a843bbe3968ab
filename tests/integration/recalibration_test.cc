// Recalibration over a real server: from a cause to the new calibration, and what a client hears of
// it that was away.
#include <grpcpp/grpcpp.h>

#include <map>

#include "absl/strings/str_cat.h"
#include "client/append_readings.h"
#include "client/wait_for_job.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/expect_status.h"
#include "tests/store/testing/fake_clock.h"
#include "truepose/v1/services.grpc.pb.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose {
namespace {

using testing::Import;
using testing::IsOk;
using testing::JobRequest;
using testing::MeasuringSession;
using testing::Uuid;

constexpr char kRobot[] = "robots/arm";

// Before the server that looks at it.
struct WithClock {
  store::FakeClock clock_;
};

class Recalibration : protected WithClock, public testing::ServerFixture {
 protected:
  Recalibration() {
    options_.clock = &clock_;
    options_.schedule = absl::Milliseconds(20);
    Restart();
    Import(NewClient(), "arm", Uuid(1), MeasuringSession(200, 1));
    Calibrate(Uuid(7), Uuid(1));
    Activate("robots/arm/calibrations/1");
  }

  std::shared_ptr<grpc::Channel> Channel() const {
    return grpc::CreateChannel(options_.listen, grpc::InsecureChannelCredentials());
  }

  void Calibrate(const std::string& job, const std::string& session) {
    const client::Client client = NewClient();
    ASSERT_THAT(client.CreateCalibrationJob(JobRequest(job, "arm", session)), IsOk());
    ASSERT_THAT(client::WaitForJob(client, absl::StrCat("jobs/", job)), IsOk());
  }

  void Activate(const std::string& calibration) {
    const auto stub = v1::CalibrationService::NewStub(Channel());
    v1::Calibration reply;
    v1::ApproveCalibrationRequest approve;
    approve.set_name(calibration);
    approve.set_reason("looked at");
    grpc::ClientContext first, second;
    ASSERT_TRUE(stub->ApproveCalibration(&first, approve, &reply).ok());
    v1::ActivateCalibrationRequest activate;
    activate.set_name(calibration);
    ASSERT_TRUE(stub->ActivateCalibration(&second, activate, &reply).ok());
  }

  v1::RecalibrationRequest Ask(int number) {
    v1::CreateRecalibrationRequestRequest request;
    request.set_parent(kRobot);
    request.set_recalibration_request_id(Uuid(number));
    const auto asked = NewClient().CreateRecalibrationRequest(request);
    EXPECT_THAT(asked, IsOk());
    return asked.value_or(v1::RecalibrationRequest());
  }

  // A sealed session with readings of the same robot, for the request.
  void Measure(const std::string& request, const std::string& session, bool good) {
    const client::Client client = NewClient();
    v1::AcknowledgeRecalibrationRequest acknowledge;
    acknowledge.set_name(request);
    ASSERT_THAT(client.AcknowledgeRecalibration(acknowledge), IsOk());
    Upload(session, MeasuringSession(good ? 150 : 3, 1));
    Report(request, session);
  }
  void Report(const std::string& request, const std::string& session) {
    v1::ReportMeasuringRequest measuring;
    measuring.set_name(request);
    measuring.set_session(absl::StrCat("sessions/", session));
    ASSERT_THAT(NewClient().ReportMeasuring(measuring), IsOk());
  }
  void Upload(const std::string& session_id, const v1::SessionInput& input) {
    const client::Client client = NewClient();
    v1::CreateSessionRequest create;
    create.set_session_id(session_id);
    create.mutable_session()->set_robot(kRobot);
    ASSERT_THAT(client.CreateSession(create), IsOk());
    const std::string name = absl::StrCat("sessions/", session_id);
    const std::vector<v1::Reading> readings(input.readings().begin(), input.readings().end());
    ASSERT_THAT(client::AppendReadings(client, name, readings, {}), IsOk());
    v1::SealSessionRequest seal;
    seal.set_name(name);
    seal.set_reading_count(input.readings_size());
    ASSERT_THAT(client.SealSession(seal), IsOk());
  }

  // Waits for the end of the request's job. @returns the request as it is then.
  v1::RecalibrationRequest Answer(const std::string& name) {
    const client::Client client = NewClient();
    v1::CalibrateForRequestRequest calibrate;
    calibrate.set_name(name);
    const auto calibrating = client.CalibrateForRequest(calibrate);
    EXPECT_THAT(calibrating, IsOk());
    EXPECT_THAT(client::WaitForJob(client, calibrating->job()), IsOk());
    v1::GetRecalibrationRequestRequest get;
    get.set_name(name);
    const auto request = client.GetRecalibrationRequest(get);
    EXPECT_THAT(request, IsOk());
    return request.value_or(v1::RecalibrationRequest());
  }

  std::vector<v1::RecalibrationRequest> Requests() {
    v1::ListRecalibrationRequestsRequest list;
    list.set_parent(kRobot);
    const auto requests = NewClient().ListRecalibrationRequests(list);
    EXPECT_THAT(requests, IsOk());
    return {requests->recalibration_requests().begin(), requests->recalibration_requests().end()};
  }
};

// What a client knows of requests from its watches.
struct Follower {
  int64_t resume = 0;
  std::string epoch;
  std::map<std::string, v1::RecalibrationState> states;
  int events = 0;

  // Watches until `done` says so; a stream that ends before fails the test.
  void Follow(const std::shared_ptr<grpc::Channel>& channel,
              const std::function<bool(const Follower&)>& done) {
    v1::WatchRequest request;
    request.add_kinds(v1::KIND_RECALIBRATION_REQUEST);
    request.set_after_revision(resume);
    request.set_epoch(epoch);
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(60));
    const auto reader = v1::WatchService::NewStub(channel)->Watch(&context, request);
    v1::WatchResponse response;
    // Within a snapshot there is nothing to resume from yet.
    while (!(resume > 0 && done(*this)) && reader->Read(&response)) Take(response);
    EXPECT_TRUE(done(*this));
    context.TryCancel();
    reader->Finish();
  }

  void Take(const v1::WatchResponse& response) {
    epoch = response.epoch();
    if (response.revision() > 0) resume = response.revision();
    for (const v1::WatchEvent& event : response.events()) {
      states[event.name()] = event.recalibration_request().state();
      ++events;
    }
  }
};

// The whole way: would catch a request that isn't done when its job is.
TEST_F(Recalibration, TheJobsEndIsTheRequestsEnd) {
  const std::string name = Ask(21).name();
  Measure(name, Uuid(2), true);
  const v1::RecalibrationRequest done = Answer(name);
  EXPECT_EQ(done.state(), v1::REQUEST_DONE);
  EXPECT_EQ(done.calibration(), "robots/arm/calibrations/2");
  v1::GetCalibrationRequest get;
  get.set_name(done.calibration());
  const auto calibration = NewClient().GetCalibration(get);
  ASSERT_THAT(calibration, IsOk());
  // The active calibration's even-odd would identify from half of a request's few poses.
  EXPECT_EQ(calibration->options().split(), "random:1:0.75");
}

// Would catch a request that is lost with a job that failed, or a second try that isn't possible.
TEST_F(Recalibration, AFailedJobGivesTheRequestBack) {
  const std::string name = Ask(21).name();
  Measure(name, Uuid(2), false);
  const v1::RecalibrationRequest back = Answer(name);
  EXPECT_EQ(back.state(), v1::REQUEST_MEASURING);
  EXPECT_NE(back.steps(back.steps_size() - 1).reason().find("FAILED"), std::string::npos);
  Upload(Uuid(3), MeasuringSession(150, 1));
  Report(name, Uuid(3));
  EXPECT_EQ(Answer(name).state(), v1::REQUEST_DONE);
}

// A client that was away while requests were raised and declined, and the server restarted: would
// catch one that it never hears of, or hears of twice.
TEST_F(Recalibration, AClientThatWasOfflineHearsOfItsRequests) {
  Follower follower;
  const std::string first = Ask(21).name();
  follower.Follow(Channel(), [&](const Follower& seen) { return seen.states.count(first) == 1; });
  const int seen = follower.events;
  v1::DeclineRecalibrationRequest decline;
  decline.set_name(first);
  decline.set_reason("not now");
  ASSERT_THAT(NewClient().DeclineRecalibration(decline), IsOk());
  Restart();
  const std::string second = Ask(22).name();
  follower.Follow(Channel(), [&](const Follower& now) { return now.states.count(second) == 1; });
  EXPECT_EQ(follower.states[first], v1::REQUEST_DECLINED);
  EXPECT_EQ(follower.states[second], v1::REQUEST_PENDING);
  EXPECT_EQ(follower.events - seen, 2);
  // Who begins anew gets what is open, and nothing that has ended.
  Follower anew;
  anew.Follow(Channel(), [&](const Follower& now) { return now.states.count(second) == 1; });
  EXPECT_EQ(anew.states.size(), 1u);
}

// Would catch a policy that nobody looks at, one that is asked for again after a restart, and a
// request that never expires.
TEST_F(Recalibration, AnIntervalRaisesOneRequestAlsoAcrossARestart) {
  v1::CreateRecalibrationPolicyRequest policy;
  policy.set_parent(kRobot);
  policy.set_recalibration_policy_id("default");
  policy.mutable_recalibration_policy()->mutable_interval()->set_seconds(90 * 86'400);
  ASSERT_THAT(NewClient().CreateRecalibrationPolicy(policy), IsOk());
  clock_.Advance(absl::Hours(24 * 91));
  Follower follower;
  const auto in_state = [](v1::RecalibrationState state) {
    return [state](const Follower& seen) {
      return !seen.states.empty() && seen.states.begin()->second == state;
    };
  };
  follower.Follow(Channel(), in_state(v1::REQUEST_PENDING));
  Restart();
  clock_.Advance(absl::Hours(24 * 7));
  follower.Follow(Channel(), in_state(v1::REQUEST_EXPIRED));
  Restart();
  const auto requests = Requests();
  ASSERT_EQ(requests.size(), 1u);
  EXPECT_EQ(requests[0].cause(), v1::CAUSE_INTERVAL);
  EXPECT_NE(requests[0].pose_set(), "");
}

}  // namespace
}  // namespace truepose
