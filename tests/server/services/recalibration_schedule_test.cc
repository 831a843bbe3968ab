#include "server/services/recalibration_schedule.h"

#include "core/base/status_macros.h"
#include "server/store/sql/query.h"
#include "server/store/tally.h"
#include "tests/server/services/recalibration_testing.h"

namespace truepose::services {
namespace {

using testing::HasFields;
using testing::IsOk;

constexpr char kThirtyDays[] = "interval { seconds: 2592000 }";
const IsStopping kNever = [] { return false; };

class RecalibrationScheduleTest : public RecalibrationFixture {
 protected:
  int Raise() {
    const auto raised = RaiseDueRequests(store(), kNever);
    EXPECT_THAT(raised, IsOk());
    return raised.value_or(-1);
  }

  void DeclineOpen() {
    v1::DeclineRecalibrationRequest request;
    request.set_name(Open().name());
    request.set_reason("no time");
    ASSERT_THAT(DeclineRecalibration(call(), request), IsOk());
  }
};

// Would catch an interval that is over and raises nothing, or a request with each look.
TEST_F(RecalibrationScheduleTest, AnIntervalRaisesOneRequest) {
  SetPolicy(kThirtyDays);
  clock_.Advance(absl::Hours(24 * 30 - 1));
  EXPECT_EQ(Raise(), 0);
  clock_.Advance(absl::Hours(1));
  EXPECT_EQ(Raise(), 1);
  EXPECT_THAT(Open(), HasFields("cause: CAUSE_INTERVAL raised_by: "
                                "'robots/ur10/recalibrationPolicies/default'"));
  EXPECT_NE(Open().pose_set(), "");
  EXPECT_EQ(Raise(), 0);
  DeclineOpen();
  EXPECT_EQ(Raise(), 0) << "declined is declined";
  clock_.Advance(absl::Hours(24 * 30));
  EXPECT_EQ(Raise(), 1) << "the next interval is another cause";
}

// Would catch a robot that is asked twice for the same: once by a person, once by the clock.
TEST_F(RecalibrationScheduleTest, ARequestThatWasOpenCounts) {
  SetPolicy(kThirtyDays);
  clock_.Advance(absl::Hours(24 * 29));
  ASSERT_THAT(Ask(kRequest1), IsOk());
  clock_.Advance(absl::Hours(48));
  EXPECT_EQ(Raise(), 0);
  DeclineOpen();
  EXPECT_EQ(Raise(), 0);
}

// Would catch an interval that is counted from the first calibration for ever.
TEST_F(RecalibrationScheduleTest, AnActivationBeginsTheIntervalAnew) {
  SetPolicy(kThirtyDays);
  clock_.Advance(absl::Hours(24 * 29));
  AddSimulatedSession(testing::kSession2, "ur10", testing::kCalibrationPoses);
  Activate(AddCalibration("ur10", testing::kSession2, testing::kJob2).name());
  clock_.Advance(absl::Hours(24 * 29));
  EXPECT_EQ(Raise(), 0);
  clock_.Advance(absl::Hours(24));
  EXPECT_EQ(Raise(), 1);
}

// Would catch a policy of one robot that keeps the others waiting, and lists that end after a page.
TEST_F(RecalibrationScheduleTest, PoliciesOfManyRobots) {
  for (int i = 0; i < 150; ++i) SetPolicy("on_failed_check: true", absl::StrCat("p", i));
  SetPolicy(kThirtyDays, "last");
  clock_.Advance(absl::Hours(24 * 31));
  EXPECT_EQ(Raise(), 1);
}

// Would catch a stop of the server that waits until a long pass has raised everything.
TEST_F(RecalibrationScheduleTest, APassEndsWhenTheServerStops) {
  SetPolicy(kThirtyDays);
  clock_.Advance(absl::Hours(24 * 31));
  EXPECT_EQ(*RaiseDueRequests(store(), [] { return true; }), 0);
  EXPECT_EQ(Raise(), 1) << "the next pass does what was left";
}

// Would catch a round, or the server's status, that reads every request and policy ever made.
TEST_F(RecalibrationScheduleTest, WhatIsOverIsNotRead) {
  SetPolicy("on_failed_check: true", "no-interval");
  ASSERT_THAT(Ask(kRequest1), IsOk());
  ASSERT_THAT(Decline(kRequest1), IsOk());
  ASSERT_THAT(Ask(kRequest2), IsOk());
  ASSERT_THAT(store().Write([&](store::Transaction& transaction) -> absl::Status {
    TRUEPOSE_RETURN_IF_ERROR(store::sql::Run(
        transaction.sql(), "UPDATE resources SET message = x'ff' WHERE id = $1", kRequest1));
    return store::sql::Run(transaction.sql(),
                           "UPDATE resources SET message = x'ff' WHERE id = 'no-interval'");
  }),
              IsOk());
  EXPECT_EQ(Raise(), 0);
  EXPECT_THAT(ExpireRequests(store(), kNever), IsOk());
  EXPECT_EQ(Open().name(), RequestName(kRequest2));
  const auto tally =
      store().Read([](store::Snapshot& snapshot) { return store::CountAll(snapshot); });
  ASSERT_THAT(tally, IsOk());
  EXPECT_EQ(tally->open_requests, 1);
}

// Would catch a store of before that counts what is over as open, or reads it with each round.
TEST_F(RecalibrationScheduleTest, WhatWasOverBeforeIsClosedByTheFirstRound) {
  ASSERT_THAT(Ask(kRequest1), IsOk());
  ASSERT_THAT(Decline(kRequest1), IsOk());
  ASSERT_THAT(store().Write([](store::Transaction& transaction) {
    return store::sql::Run(transaction.sql(), "UPDATE resources SET open = 1 WHERE kind = 5");
  }),
              IsOk());
  const auto open = [&] {
    return *store().Read([](store::Snapshot& snapshot) {
      return store::sql::QueryInt64(snapshot.sql(),
                                    "SELECT COUNT(*) FROM resources WHERE open = 1");
    });
  };
  EXPECT_EQ(store().Read([](store::Snapshot& s) { return store::CountAll(s); })->open_requests, 0);
  EXPECT_EQ(open(), 1);
  EXPECT_EQ(*ExpireRequests(store(), kNever), 0);
  EXPECT_EQ(open(), 0);
  EXPECT_EQ(Stored(kRequest1).state(), v1::REQUEST_DECLINED);
}

// Would catch a policy that was given an interval later, or a request, that no round looks at.
TEST_F(RecalibrationScheduleTest, WhatBecomesOpenIsRead) {
  SetPolicy("on_failed_check: true");
  v1::UpdateRecalibrationPolicyRequest update;
  update.mutable_recalibration_policy()->set_name("robots/ur10/recalibrationPolicies/default");
  update.mutable_recalibration_policy()->mutable_interval()->set_seconds(2592000);
  update.mutable_update_mask()->add_paths("interval");
  v1::RecalibrationPolicy policy;
  ASSERT_THAT(UpdateStandard(call(), update, policy), IsOk());
  clock_.Advance(absl::Hours(24 * 31));
  EXPECT_EQ(Raise(), 1);
}

// Would catch a request that stays open for ever, or that expires before its time or twice.
TEST_F(RecalibrationScheduleTest, RequestsExpire) {
  SetPolicy("expire_after { seconds: 3600 }");
  ASSERT_THAT(Ask(kRequest1), IsOk());
  ASSERT_THAT(Acknowledge(kRequest1), IsOk());
  clock_.Advance(absl::Minutes(59));
  EXPECT_EQ(*ExpireRequests(store(), kNever), 0);
  clock_.Advance(absl::Minutes(1));
  EXPECT_EQ(*ExpireRequests(store(), kNever), 1);
  EXPECT_EQ(*ExpireRequests(store(), kNever), 0);
  const v1::RecalibrationRequest expired = Stored(kRequest1);
  EXPECT_EQ(expired.state(), v1::REQUEST_EXPIRED);
  EXPECT_EQ(expired.steps_size(), 3);
  EXPECT_THAT(Ask(kRequest2), IsOk());
  clock_.Advance(absl::Hours(2));
  EXPECT_THAT(Decline(kRequest2), IsOk());
  EXPECT_EQ(*ExpireRequests(store(), kNever), 0) << "what has ended doesn't expire";
}

}  // namespace
}  // namespace truepose::services
