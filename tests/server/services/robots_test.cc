#include "server/services/robots.h"

#include "tests/server/testing/handler_test.h"

namespace truepose::services {
namespace {

using testing::HandlerTest;
using testing::HasCode;
using testing::HasFaultsAt;
using testing::HasFields;
using testing::IsOk;
using testing::Parse;
using testing::RobotRequest;
using testing::SixAxes;
using Fields = std::vector<std::string>;

class RobotsTest : public HandlerTest {};

v1::GetRobotRequest Get(const std::string& name) {
  v1::GetRobotRequest request;
  request.set_name(name);
  return request;
}

v1::CreateNominalRevisionRequest RevisionRequest(const std::string& parent,
                                                 const std::string& serial) {
  v1::CreateNominalRevisionRequest request;
  request.set_parent(parent);
  *request.mutable_nominal() = SixAxes(serial);
  return request;
}

// Would catch a reply that is not what is stored, or one without name, revision or etag.
TEST_F(RobotsTest, CreatedRobotIsWhatGetReturns) {
  const auto created = CreateRobot(call(), RobotRequest("ur10"));
  ASSERT_THAT(created, IsOk());
  EXPECT_THAT(*created, HasFields(R"pb(
    name: "robots/ur10"
    nominal_revision {
      name: "robots/ur10/nominals/1"
      nominal { serial: "1" model: "Six" }
    })pb"));
  EXPECT_GT(created->revision(), 0);
  EXPECT_NE(created->etag(), "");
  EXPECT_GT(created->create_time().seconds(), 0);
  EXPECT_EQ(created->nominal_revision().digest().size(), 64u);
  const auto got = GetRobot(call(), Get("robots/ur10"));
  ASSERT_THAT(got, IsOk());
  EXPECT_EQ(got->SerializeAsString(), created->SerializeAsString());
}

// Would catch a create that can't be repeated after a lost answer.
TEST_F(RobotsTest, RepeatedCreateReturnsTheSameRobot) {
  const auto first = CreateRobot(call(), RobotRequest("ur10"));
  const auto second = CreateRobot(call(), RobotRequest("ur10"));
  ASSERT_THAT(second, IsOk());
  EXPECT_EQ(first->SerializeAsString(), second->SerializeAsString());
}

// Would catch a create that overwrites another robot of that name.
TEST_F(RobotsTest, CreateWithOtherContentIsRefused) {
  AddRobot("ur10");
  EXPECT_THAT(CreateRobot(call(), RobotRequest("ur10", "2")),
              HasCode(absl::StatusCode::kAlreadyExists));
}

// Would catch a create that stops at the first fault, or leaves the path of the message out.
TEST_F(RobotsTest, CreateNamesEveryFault) {
  auto request = RobotRequest("UR 10");
  request.mutable_nominal()->mutable_joints(2)->set_lower(7.0);
  const auto created = CreateRobot(call(), request);
  ASSERT_THAT(created, HasCode(absl::StatusCode::kInvalidArgument));
  const Fields fields = testing::FieldsOf(created.status());
  EXPECT_THAT(fields, ::testing::Contains("robot_id"));
  EXPECT_THAT(fields, ::testing::Contains(::testing::StartsWith("nominal.joints[2]")));
}

// Would catch a validate_only that writes, or that does not look at what is stored.
TEST_F(RobotsTest, ValidateOnlyStoresNothing) {
  auto request = RobotRequest("ur10");
  request.set_validate_only(true);
  ASSERT_THAT(CreateRobot(call(), request), IsOk());
  EXPECT_THAT(GetRobot(call(), Get("robots/ur10")), HasCode(absl::StatusCode::kNotFound));
  AddRobot("ur10");
  auto other = RobotRequest("ur10", "2");
  other.set_validate_only(true);
  EXPECT_THAT(CreateRobot(call(), other), HasCode(absl::StatusCode::kAlreadyExists));
}

// Would catch an unknown name that is taken for a fault of the request, or the reverse.
TEST_F(RobotsTest, GetTellsUnknownFromMalformed) {
  EXPECT_THAT(GetRobot(call(), Get("robots/none")), HasCode(absl::StatusCode::kNotFound));
  EXPECT_THAT(GetRobot(call(), Get("none")), HasFaultsAt(Fields{"name"}));
}

// Would catch pages that lose, repeat or reorder robots.
TEST_F(RobotsTest, PagesAddUpToAllRobots) {
  for (const char* id : {"c", "a", "b"}) AddRobot(id);
  auto request = Parse<v1::ListRobotsRequest>("page_size: 2");
  const auto first = ListRobots(call(), request);
  ASSERT_THAT(first, IsOk());
  ASSERT_EQ(first->robots_size(), 2);
  EXPECT_EQ(first->robots(0).name(), "robots/a");
  request.set_page_token(first->next_page_token());
  const auto second = ListRobots(call(), request);
  ASSERT_THAT(second, IsOk());
  ASSERT_EQ(second->robots_size(), 1);
  EXPECT_EQ(second->robots(0).name(), "robots/c");
  EXPECT_EQ(second->next_page_token(), "");
}

// Would catch a list that takes any token or size.
TEST_F(RobotsTest, ListNamesFaultsOfThePage) {
  const auto request = Parse<v1::ListRobotsRequest>(R"pb(page_size: -1 page_token: "no token")pb");
  EXPECT_THAT(ListRobots(call(), request), HasFaultsAt(Fields{"page_size", "page_token"}));
}

// Would catch a revision that is not added, is added twice, or changes the first one.
TEST_F(RobotsTest, RevisionsAreAddedOnceAndStay) {
  AddRobot("ur10");
  const auto second = CreateNominalRevision(call(), RevisionRequest("robots/ur10", "2"));
  ASSERT_THAT(second, IsOk());
  EXPECT_THAT(*second, HasFields(R"pb(name: "robots/ur10/nominals/2"
                                      nominal { serial: "2" })pb"));
  const auto repeat = CreateNominalRevision(call(), RevisionRequest("robots/ur10", "2"));
  ASSERT_THAT(repeat, IsOk());
  EXPECT_EQ(repeat->name(), "robots/ur10/nominals/2");
  const auto first = GetNominalRevision(
      call(), Parse<v1::GetNominalRevisionRequest>(R"pb(name: "robots/ur10/nominals/1")pb"));
  ASSERT_THAT(first, IsOk());
  EXPECT_EQ(first->nominal().serial(), "1");
}

// Would catch a revision of nobody's robot, or one that is not checked.
TEST_F(RobotsTest, RevisionNeedsItsRobotAndGoodContent) {
  EXPECT_THAT(CreateNominalRevision(call(), RevisionRequest("robots/none", "2")),
              HasCode(absl::StatusCode::kNotFound));
  auto request = RevisionRequest("ur10", "2");
  request.mutable_nominal()->mutable_joints(0)->set_lower(7.0);
  const auto refused = CreateNominalRevision(call(), request);
  ASSERT_THAT(refused, HasCode(absl::StatusCode::kInvalidArgument));
  EXPECT_THAT(testing::FieldsOf(refused.status()), ::testing::Contains("parent"));
  EXPECT_THAT(testing::FieldsOf(refused.status()),
              ::testing::Contains(::testing::StartsWith("nominal.joints[0]")));
}

// Would catch an unknown revision that is answered with another one.
TEST_F(RobotsTest, GetRevisionTellsUnknownFromMalformed) {
  AddRobot("ur10");
  const auto unknown =
      Parse<v1::GetNominalRevisionRequest>(R"pb(name: "robots/ur10/nominals/7")pb");
  EXPECT_THAT(GetNominalRevision(call(), unknown), HasCode(absl::StatusCode::kNotFound));
  const auto malformed =
      Parse<v1::GetNominalRevisionRequest>(R"pb(name: "robots/ur10/nominals/x")pb");
  EXPECT_THAT(GetNominalRevision(call(), malformed), HasFaultsAt(Fields{"name"}));
}

// Would catch a list of revisions that mixes robots or hides that the robot is unknown.
TEST_F(RobotsTest, ListRevisionsIsOfOneRobot) {
  AddRobot("ur10");
  AddRobot("other");
  ASSERT_THAT(CreateNominalRevision(call(), RevisionRequest("robots/ur10", "2")), IsOk());
  const auto listed = ListNominalRevisions(
      call(), Parse<v1::ListNominalRevisionsRequest>(R"pb(parent: "robots/ur10")pb"));
  ASSERT_THAT(listed, IsOk());
  ASSERT_EQ(listed->nominal_revisions_size(), 2);
  EXPECT_EQ(listed->nominal_revisions(0).name(), "robots/ur10/nominals/2");
  const auto unknown = Parse<v1::ListNominalRevisionsRequest>(R"pb(parent: "robots/none")pb");
  EXPECT_THAT(ListNominalRevisions(call(), unknown), HasCode(absl::StatusCode::kNotFound));
  const auto malformed = Parse<v1::ListNominalRevisionsRequest>(R"pb(parent: "none")pb");
  EXPECT_THAT(ListNominalRevisions(call(), malformed), HasFaultsAt(Fields{"parent"}));
}

}  // namespace
}  // namespace truepose::services
