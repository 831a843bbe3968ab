// A robot with an active calibration, and requests to recalibrate it.
#pragma once

#include <string>

#include "absl/strings/str_cat.h"
#include "server/services/recalibration.h"
#include "server/services/recalibration_requests.h"
#include "server/services/release.h"
#include "server/services/standard.h"
#include "server/services/stored_resources.h"
#include "tests/server/testing/handler_test.h"
#include "tests/store/testing/fake_clock.h"
#include "truepose/v1/plant_services.pb.h"

namespace truepose::services {

inline constexpr char kRobot[] = "robots/ur10";
inline constexpr char kRequest1[] = "00000000-0000-4000-8000-0000000000a1";
inline constexpr char kRequest2[] = "00000000-0000-4000-8000-0000000000a2";

inline std::string RequestName(const std::string& id) {
  return absl::StrCat(kRobot, "/recalibrationRequests/", id);
}

// Before the store that looks at it.
class WithClock {
 protected:
  store::FakeClock clock_;
};

class RecalibrationFixture : protected WithClock, public testing::HandlerTest {
 protected:
  RecalibrationFixture() : HandlerTest(&clock_) {
    AddRobot("ur10");
    AddSimulatedSession(testing::kSession1, "ur10", testing::kCalibrationPoses);
    Activate(AddCalibration("ur10", testing::kSession1, testing::kJob1).name());
  }

  void Activate(const std::string& calibration) {
    v1::ApproveCalibrationRequest approve;
    approve.set_name(calibration);
    approve.set_reason("ok");
    ASSERT_THAT(ApproveCalibration(call(), approve), testing::IsOk());
    v1::ActivateCalibrationRequest activate;
    activate.set_name(calibration);
    ASSERT_THAT(ActivateCalibration(call(), activate), testing::IsOk());
  }

  CallContext As(const std::string& principal, bool is_machine = false) {
    CallContext context = call();
    context.caller = {
        .principal = principal, .is_machine = is_machine, .is_admin = false, .is_local_dev = false};
    return context;
  }

  absl::StatusOr<v1::RecalibrationRequest> Ask(const std::string& id,
                                               const std::string& content = "reason: 'a bump'") {
    v1::CreateRecalibrationRequestRequest request;
    request.set_parent(kRobot);
    request.set_recalibration_request_id(id);
    *request.mutable_recalibration_request() = testing::Parse<v1::RecalibrationRequest>(content);
    return CreateRecalibrationRequest(As("anna"), request);
  }

  absl::StatusOr<v1::RecalibrationRequest> Acknowledge(const std::string& id) {
    v1::AcknowledgeRecalibrationRequest request;
    request.set_name(RequestName(id));
    return AcknowledgeRecalibration(As("agent", true), request);
  }

  absl::StatusOr<v1::RecalibrationRequest> Measure(const std::string& id,
                                                   const std::string& session, int readings) {
    v1::ReportMeasuringRequest request;
    request.set_name(RequestName(id));
    request.set_session(session);
    request.set_readings_taken(readings);
    return ReportMeasuring(As("agent", true), request);
  }

  absl::StatusOr<v1::RecalibrationRequest> Calibrate(const std::string& id) {
    v1::CalibrateForRequestRequest request;
    request.set_name(RequestName(id));
    return CalibrateForRequest(As("agent", true), request);
  }

  absl::StatusOr<v1::RecalibrationRequest> Decline(const std::string& id) {
    v1::DeclineRecalibrationRequest request;
    request.set_name(RequestName(id));
    request.set_reason("it is being scrapped");
    return DeclineRecalibration(As("ben"), request);
  }

  void SetPolicy(const std::string& content, const std::string& id = "default") {
    v1::CreateRecalibrationPolicyRequest request;
    request.set_parent(kRobot);
    request.set_recalibration_policy_id(id);
    *request.mutable_recalibration_policy() = testing::Parse<v1::RecalibrationPolicy>(content);
    v1::RecalibrationPolicy policy;
    ASSERT_THAT(CreateStandard(call(), request, policy), testing::IsOk());
  }

  // @returns its name.
  std::string AddPoseSet(const std::string& id, const std::string& robot = kRobot) {
    v1::CreatePoseSetRequest request;
    request.set_parent(robot);
    request.set_pose_set_id(id);
    *request.mutable_pose_set() = testing::Parse<v1::PoseSet>(
        "purpose: POSE_SET_CALIBRATE poses { joints: [0, 0, 0, 0, 0, 0] }");
    v1::PoseSet set;
    EXPECT_THAT(CreateStandard(call(), request, set), testing::IsOk());
    return set.name();
  }

  // The only request that is open.
  v1::RecalibrationRequest Open() {
    auto open =
        store().Read([](store::Snapshot& snapshot) { return FindOpenRequest(snapshot, kRobot); });
    EXPECT_THAT(open, testing::IsOk());
    return open->value_or(v1::RecalibrationRequest());
  }

  template <typename T>
  std::vector<T> All() {
    auto all =
        store().Read([](store::Snapshot& snapshot) { return AllOfRobot<T>(snapshot, kRobot); });
    EXPECT_THAT(all, testing::IsOk());
    return *std::move(all);
  }

  v1::RecalibrationRequest Stored(const std::string& id) {
    auto stored = store().Read([&](store::Snapshot& snapshot) {
      return GetResource<v1::RecalibrationRequest>(snapshot, RequestName(id));
    });
    EXPECT_THAT(stored, testing::IsOk());
    return stored.value_or(v1::RecalibrationRequest());
  }
};

}  // namespace truepose::services
