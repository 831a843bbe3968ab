#include "server/services/sessions.h"

#include <tuple>

#include "absl/strings/str_cat.h"
#include "server/services/standard.h"
#include "tests/server/testing/handler_test.h"
#include "truepose/v1/plant_services.pb.h"

namespace truepose::services {
namespace {

using testing::Batch;
using testing::HandlerTest;
using testing::HasCode;
using testing::HasFaultsAt;
using testing::HasFields;
using testing::IsOk;
using testing::kSession1;
using testing::kSession2;
using testing::kUnknown;
using testing::Parse;
using testing::SessionRequest;
using Fields = std::vector<std::string>;

std::string Name(const std::string& id) { return absl::StrCat("sessions/", id); }

v1::SealSessionRequest Seal(const std::string& name, int count) {
  v1::SealSessionRequest request;
  request.set_name(name);
  request.set_reading_count(count);
  return request;
}

v1::GetSessionRequest Get(const std::string& name) {
  v1::GetSessionRequest request;
  request.set_name(name);
  return request;
}

class SessionsTest : public HandlerTest {
 protected:
  SessionsTest() { AddRobot("ur10"); }
};

// Would catch a session without state, nominal revision or etag.
TEST_F(SessionsTest, CreatedSessionIsOpenAndOfTheLatestNominal) {
  const auto created = CreateSession(call(), SessionRequest(kSession1, "robots/ur10"));
  ASSERT_THAT(created, IsOk());
  EXPECT_THAT(*created, HasFields(absl::StrCat(R"pb(name: "sessions/)pb", kSession1,
                                               R"pb("
                                                    robot: "robots/ur10"
                                                    nominal_revision: "robots/ur10/nominals/1"
                                                    display_name: "first measurement"
                                                    state: OPEN)pb")));
  EXPECT_NE(created->etag(), "");
  const auto got = GetSession(call(), Get(Name(kSession1)));
  ASSERT_THAT(got, IsOk());
  EXPECT_EQ(got->SerializeAsString(), created->SerializeAsString());
}

// Would catch a create that can't be repeated, or that a second session of the same id passes for
// the first.
TEST_F(SessionsTest, RepeatedCreateIsHarmlessAndAnotherIsRefused) {
  const auto first = CreateSession(call(), SessionRequest(kSession1, "robots/ur10"));
  const auto second = CreateSession(call(), SessionRequest(kSession1, "robots/ur10"));
  ASSERT_THAT(second, IsOk());
  EXPECT_EQ(first->SerializeAsString(), second->SerializeAsString());
  auto other = SessionRequest(kSession1, "robots/ur10");
  other.mutable_session()->set_display_name("another");
  EXPECT_THAT(CreateSession(call(), other), HasCode(absl::StatusCode::kAlreadyExists));
}

TEST_F(SessionsTest, CreateNamesEveryFault) {
  auto request = SessionRequest("no-uuid", "ur10");
  request.mutable_session()->set_instrument("lt-1");
  request.mutable_session()->set_nominal_revision("1");
  EXPECT_THAT(CreateSession(call(), request),
              HasFaultsAt(Fields{"session_id", "session.robot", "session.nominal_revision",
                                 "session.instrument"}));
}

TEST_F(SessionsTest, CreateNeedsItsRobot) {
  EXPECT_THAT(CreateSession(call(), SessionRequest(kSession1, "robots/none")),
              HasCode(absl::StatusCode::kNotFound));
}

TEST_F(SessionsTest, GetTellsUnknownFromMalformed) {
  EXPECT_THAT(GetSession(call(), Get(Name(kUnknown))), HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(GetSession(call(), Get("sessions/1")), HasFaultsAt(Fields{"name"}));
}

// Would catch a filter by robot that does not filter.
TEST_F(SessionsTest, ListIsOfOneRobotOrOfAll) {
  AddRobot("other");
  AddSession(kSession1, "ur10", 1);
  AddSession(kSession2, "other", 1);
  const auto one =
      ListSessions(call(), Parse<v1::ListSessionsRequest>(R"pb(robot: "robots/other")pb"));
  ASSERT_THAT(one, IsOk());
  ASSERT_EQ(one->sessions_size(), 1);
  EXPECT_EQ(one->sessions(0).name(), Name(kSession2));
  const auto all = ListSessions(call(), {});
  ASSERT_THAT(all, IsOk());
  EXPECT_EQ(all->sessions_size(), 2);
}

TEST_F(SessionsTest, ListNamesFaults) {
  EXPECT_THAT(ListSessions(call(), Parse<v1::ListSessionsRequest>("page_size: -1")),
              HasFaultsAt(Fields{"page_size"}));
}

// Would catch an acknowledgement that does not count what is stored.
TEST_F(SessionsTest, AppendAcknowledgesWhatIsStored) {
  AddSession(kSession1, "ur10", 3);
  const auto more = Append(Batch(kSession1, 3, 2));
  ASSERT_THAT(more, IsOk());
  EXPECT_EQ(more->reading_count(), 5);
  const auto stored =
      ListReadings(call(), Parse<v1::ListReadingsRequest>(
                               absl::StrCat(R"pb(session: "sessions/)pb", kSession1, R"pb(")pb")));
  ASSERT_THAT(stored, IsOk());
  ASSERT_EQ(stored->readings_size(), 5);
  v1::Reading last = stored->readings(4);
  EXPECT_TRUE(last.has_server_time()) << "what a repeat is not compared by";
  last.clear_server_time();
  EXPECT_EQ(last.SerializeAsString(), Batch(kSession1, 4, 1).readings(0).SerializeAsString());
}

// Would catch rows that are stored twice when an acknowledgement was lost, or overwritten by other
// ones.
TEST_F(SessionsTest, RepeatedRowsAreAcknowledgedAndOtherRowsAborted) {
  AddSession(kSession1, "ur10", 3);
  const auto again = Append(Batch(kSession1, 1, 3));
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(again->reading_count(), 4);
  auto other = Batch(kSession1, 1, 1);
  other.mutable_readings(0)->mutable_position_m()->set_x(9);
  EXPECT_THAT(Append(other), HasCode(absl::StatusCode::kAborted));
}

// Would catch a batch with a hole, which would shift every later row.
TEST_F(SessionsTest, AppendRefusesAGap) {
  AddSession(kSession1, "ur10", 3);
  EXPECT_THAT(Append(Batch(kSession1, 4, 1)), HasCode(absl::StatusCode::kOutOfRange));
}

// Would catch readings that are not checked against the robot, and faults without their place.
TEST_F(SessionsTest, AppendNamesEveryFaultOfTheReadings) {
  AddSession(kSession1, "ur10", 0);
  auto request = Batch(kSession1, 0, 3);
  request.mutable_readings(0)->add_joints_measured(1.0);
  request.mutable_readings(2)->mutable_position_m()->set_y(
      std::numeric_limits<double>::quiet_NaN());
  const auto refused = Append(request);
  ASSERT_THAT(refused, HasCode(absl::StatusCode::kInvalidArgument));
  const Fields fields = testing::FieldsOf(refused.status());
  EXPECT_THAT(fields, ::testing::Contains(::testing::StartsWith("readings[0].joints_measured")));
  EXPECT_THAT(fields, ::testing::Contains(::testing::StartsWith("readings[2].position_m")));
  EXPECT_EQ(GetSession(call(), Get(Name(kSession1)))->reading_count(), 0)
      << "half a batch was stored";
}

// Would catch a batch without bound, or rows below zero.
TEST_F(SessionsTest, AppendBoundsTheBatch) {
  AddSession(kSession1, "ur10", 0);
  EXPECT_THAT(Append(Batch(kSession1, 0, kMostReadingsOfBatch + 1)),
              HasFaultsAt(Fields{"readings"}));
  EXPECT_THAT(Append(Batch(kSession1, -1, 2)), HasFaultsAt(Fields{"readings[0].row"}));
  EXPECT_THAT(Append(Batch(kSession1, 0, kMostReadingsOfBatch)), IsOk());
}

// Would catch a stream that writes into two sessions, or into none.
TEST_F(SessionsTest, AStreamIsOfOneSession) {
  AddSession(kSession1, "ur10", 1);
  AddSession(kSession2, "ur10", 1);
  AppendStream stream(call());
  ASSERT_THAT(testing::AppendAndWait(stream, Batch(kSession1, 1, 1)), IsOk());
  auto unnamed = Batch(kSession1, 2, 1);
  unnamed.clear_session();
  EXPECT_THAT(testing::AppendAndWait(stream, unnamed), IsOk());
  EXPECT_THAT(testing::AppendAndWait(stream, Batch(kSession2, 1, 1)),
              HasFaultsAt(Fields{"session"}));
  EXPECT_THAT(Append(unnamed), HasFaultsAt(Fields{"session"}));
  EXPECT_THAT(Append(Batch(kUnknown, 0, 1)), HasCode(absl::StatusCode::kNotFound));
}

// Would catch a seal that can't be repeated, or leaves the session open for more.
TEST_F(SessionsTest, SealedSessionHasADigestAndTakesNothing) {
  AddSession(kSession1, "ur10", 3);
  const auto sealed = SealSession(call(), Seal(Name(kSession1), 3));
  ASSERT_THAT(sealed, IsOk());
  EXPECT_THAT(*sealed, HasFields("state: SEALED reading_count: 3"));
  EXPECT_EQ(sealed->digest().size(), 64u);
  const auto again = SealSession(call(), Seal(Name(kSession1), 3));
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(again->SerializeAsString(), sealed->SerializeAsString());
  EXPECT_THAT(Append(Batch(kSession1, 3, 1)), HasCode(absl::StatusCode::kFailedPrecondition));
}

// Would catch a certificate that had run out and nobody hears of it, or that a valid one is said to
// have: what counts is the moment of sealing.
TEST_F(SessionsTest, SealKeepsThatTheCertificateHadExpired) {
  const auto add = [&](const std::string& id, int64_t expires) {
    v1::CreateInstrumentRequest request;
    request.set_instrument_id(id);
    request.mutable_instrument()->set_serial(id);
    request.mutable_instrument()->mutable_certificate_expire_time()->set_seconds(expires);
    v1::Instrument created;
    ASSERT_THAT(CreateStandard(call(), request, created), IsOk());
  };
  add("old", 1000000000);
  add("new", 9000000000);
  for (const auto& [session, instrument, expired] :
       {std::tuple{kSession1, "old", true}, std::tuple{kSession2, "new", false}}) {
    auto request = SessionRequest(session, "robots/ur10");
    request.mutable_session()->set_instrument(absl::StrCat("instruments/", instrument));
    ASSERT_THAT(CreateSession(call(), request), IsOk());
    ASSERT_THAT(Append(Batch(session, 0, 3)), IsOk());
    const auto sealed = SealSession(call(), Seal(Name(session), 3));
    ASSERT_THAT(sealed, IsOk());
    EXPECT_EQ(sealed->certificate_expired_time().seconds(), expired ? 1000000000 : 0);
  }
}

// Would catch a session that is sealed with readings missing.
TEST_F(SessionsTest, SealRefusesAnotherCount) {
  AddSession(kSession1, "ur10", 3);
  EXPECT_THAT(SealSession(call(), Seal(Name(kSession1), 4)),
              HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(GetSession(call(), Get(Name(kSession1)))->state(), v1::OPEN);
}

TEST_F(SessionsTest, SealTellsUnknownFromMalformed) {
  EXPECT_THAT(SealSession(call(), Seal(Name(kUnknown), 1)), HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(SealSession(call(), Seal("1", 1)), HasFaultsAt(Fields{"name"}));
}

TEST_F(SessionsTest, ListReadingsPagesByRow) {
  AddSession(kSession1, "ur10", 5);
  auto request = Parse<v1::ListReadingsRequest>("page_size: 3");
  request.set_session(Name(kSession1));
  const auto first = ListReadings(call(), request);
  ASSERT_THAT(first, IsOk());
  ASSERT_EQ(first->readings_size(), 3);
  request.set_page_token(first->next_page_token());
  const auto second = ListReadings(call(), request);
  ASSERT_THAT(second, IsOk());
  ASSERT_EQ(second->readings_size(), 2);
  EXPECT_EQ(second->readings(0).row(), 3);
}

TEST_F(SessionsTest, ListReadingsTellsUnknownFromMalformed) {
  v1::ListReadingsRequest request;
  request.set_session(Name(kUnknown));
  EXPECT_THAT(ListReadings(call(), request), HasCode(absl::StatusCode::kNotFound));
  request.set_session("1");
  EXPECT_THAT(ListReadings(call(), request), HasFaultsAt(Fields{"session"}));
}

}  // namespace
}  // namespace truepose::services
