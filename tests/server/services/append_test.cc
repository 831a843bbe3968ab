// One stream of readings from a source. Streams by row are in sessions_test.cc.
#include "server/services/append.h"

#include "absl/strings/str_cat.h"
#include "server/services/sessions.h"
#include "tests/server/testing/handler_test.h"

namespace truepose::services {
namespace {

using testing::AppendAndWait;
using testing::HandlerTest;
using testing::HasCode;
using testing::HasFaultsAt;
using testing::HasFields;
using testing::IsOk;
using testing::kSession1;
using testing::kSession2;
using testing::kUnknown;
using Fields = std::vector<std::string>;

constexpr char kSource[] = "00000000-0000-4000-8000-0000000000aa";
constexpr char kOther[] = "00000000-0000-4000-8000-0000000000bb";

v1::AppendReadingsRequest Spooled(const std::string& session_id, int first, int count) {
  v1::AppendReadingsRequest request = testing::Batch(session_id, 0, count);
  request.set_source(kSource);
  request.set_first_sequence(first);
  return request;
}

v1::AppendReadingsRequest Question(const std::string& source) {
  v1::AppendReadingsRequest request;
  request.set_source(source);
  return request;
}

class AppendTest : public HandlerTest {
 protected:
  AppendTest() {
    AddRobot("ur10");
    AddSession(kSession1, "ur10", 0);
    AddSession(kSession2, "ur10", 0);
  }
  AppendStream stream_{call()};
};

// Would catch a stream that stays in its first session, or whose progress is the session's count.
TEST_F(AppendTest, AStreamOfASourceNamesManySessions) {
  EXPECT_THAT(*AppendAndWait(stream_, Question(kSource)), HasFields("durable_sequence: 0"));
  EXPECT_THAT(*AppendAndWait(stream_, Spooled(kSession1, 1, 3)),
              HasFields("reading_count: 3 durable_sequence: 3"));
  EXPECT_THAT(*AppendAndWait(stream_, Spooled(kSession2, 4, 2)),
              HasFields("reading_count: 2 durable_sequence: 5"));
  auto unnamed = Spooled(kSession2, 6, 1);
  unnamed.clear_session();
  unnamed.clear_source();
  EXPECT_THAT(*AppendAndWait(stream_, unnamed), HasFields("reading_count: 3 durable_sequence: 6"))
      << "what isn't named is as before";
  AppendStream later(call());
  EXPECT_THAT(*AppendAndWait(later, Question(kSource)), HasFields("durable_sequence: 6"));
}

// Would catch a stream in which two spools are mixed, or that changes its way of addressing.
TEST_F(AppendTest, AStreamHasOneSource) {
  ASSERT_THAT(AppendAndWait(stream_, Spooled(kSession1, 1, 1)), IsOk());
  auto other = Spooled(kSession1, 2, 1);
  other.set_source(kOther);
  EXPECT_THAT(AppendAndWait(stream_, other), HasFaultsAt(Fields{"source"}));
  AppendStream by_row(call());
  ASSERT_THAT(AppendAndWait(by_row, testing::Batch(kSession2, 0, 1)), IsOk());
  EXPECT_THAT(AppendAndWait(by_row, Spooled(kSession2, 1, 1)), HasFaultsAt(Fields{"source"}));
}

// Would catch a message that is refused for one fault at a time, or none.
TEST_F(AppendTest, FaultsOfTheMessage) {
  EXPECT_THAT(AppendAndWait(stream_, Question("spool")), HasFaultsAt(Fields{"source"}));
  EXPECT_THAT(AppendAndWait(stream_, Spooled(kSession1, 0, 1)),
              HasFaultsAt(Fields{"first_sequence"}));
  EXPECT_THAT(AppendAndWait(stream_, Spooled(kSession1, 1, kMostReadingsOfBatch + 1)),
              HasFaultsAt(Fields{"readings"}));
  auto wrong = Spooled(kSession1, 1, 2);
  wrong.mutable_readings(1)->add_joints_measured(1);
  const auto refused = AppendAndWait(stream_, wrong);
  ASSERT_THAT(refused, HasCode(absl::StatusCode::kInvalidArgument));
  EXPECT_THAT(testing::FieldsOf(refused.status()),
              ::testing::Contains(::testing::StartsWith("readings[1].joints_measured")));
}

// Would catch a client that is not told that it has to create its session here first.
TEST_F(AppendTest, AnUnknownSessionSaysWhatToDo) {
  const auto unknown = AppendAndWait(stream_, Spooled(kUnknown, 1, 1));
  EXPECT_THAT(unknown, HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(std::string(unknown.status().message()), ::testing::HasSubstr("create it"));
}

v1::DeleteSessionRequest Deletion(const std::string& session_id) {
  v1::DeleteSessionRequest request;
  request.set_name(absl::StrCat("sessions/", session_id));
  return request;
}

// Would catch readings that vanish in a session that nobody sees, and an upload that can't end
// because what is stored is not acknowledged any more.
TEST_F(AppendTest, ADeletedSessionTakesNothingNewAndAcknowledgesWhatItHas) {
  ASSERT_THAT(Append(testing::Batch(kSession1, 0, 2)), IsOk());
  ASSERT_THAT(AppendAndWait(stream_, Spooled(kSession2, 1, 2)), IsOk());
  ASSERT_THAT(DeleteSession(call(), Deletion(kSession1)), IsOk());
  ASSERT_THAT(DeleteSession(call(), Deletion(kSession2)), IsOk());
  EXPECT_THAT(Append(testing::Batch(kSession1, 2, 1)),
              HasCode(absl::StatusCode::kFailedPrecondition));
  const auto refused = AppendAndWait(stream_, Spooled(kSession2, 3, 1));
  EXPECT_THAT(refused, HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(std::string(refused.status().message()), ::testing::HasSubstr("undelete it"));
  EXPECT_THAT(Append(testing::Batch(kSession1, 0, 2)), IsOk());
  EXPECT_THAT(*AppendAndWait(stream_, Spooled(kSession2, 1, 2)), HasFields("durable_sequence: 2"));
}

// Would catch a message that waits for the store in gRPC's own thread.
TEST_F(AppendTest, OnlySmallMessagesOfKnownSessionsAreQuick) {
  EXPECT_FALSE(stream_.IsQuick(Spooled(kSession1, 1, 1))) << "the session has to be read";
  ASSERT_THAT(AppendAndWait(stream_, Spooled(kSession1, 1, 1)), IsOk());
  EXPECT_TRUE(stream_.IsQuick(Spooled(kSession1, 2, 100)));
  EXPECT_FALSE(stream_.IsQuick(Spooled(kSession1, 2, 5000)));
  EXPECT_FALSE(stream_.IsQuick(Spooled(kSession2, 2, 1)));
  EXPECT_FALSE(stream_.IsQuick(Question(kSource)));
}

}  // namespace
}  // namespace truepose::services
