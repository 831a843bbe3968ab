#include "server/services/standard.h"

#include <thread>

#include "absl/strings/str_cat.h"
#include "tests/server/testing/handler_test.h"
#include "truepose/v1/plant_services.pb.h"

namespace truepose::services {
namespace {

using testing::HandlerTest;
using testing::HasCode;
using testing::HasFaultsAt;
using testing::IsOk;
using testing::kJob1;
using testing::Parse;
using Fields = std::vector<std::string>;

// Would catch any difference between what the methods promise and do, for all kinds at once: they
// share the code.
class StandardTest : public HandlerTest {
 protected:
  v1::CreateInstrumentRequest Tracker(const std::string& id = "at960") {
    v1::CreateInstrumentRequest request;
    request.set_instrument_id(id);
    request.mutable_instrument()->set_serial("750123");
    request.mutable_instrument()->set_position_sd_m(15e-6);
    return request;
  }

  absl::StatusOr<v1::Instrument> Create(const v1::CreateInstrumentRequest& request) {
    v1::Instrument made;
    const absl::Status status = CreateStandard(call(), request, made);
    if (!status.ok()) return status;
    return made;
  }

  absl::StatusOr<v1::Instrument> Update(const v1::UpdateInstrumentRequest& request) {
    v1::Instrument made;
    const absl::Status status = UpdateStandard(call(), request, made);
    if (!status.ok()) return status;
    return made;
  }

  absl::StatusOr<v1::ListInstrumentsResponse> List(const std::string& filter, int size = 0,
                                                   const std::string& token = "",
                                                   bool deleted = false) {
    v1::ListInstrumentsRequest request;
    request.set_filter(filter);
    request.set_page_size(size);
    request.set_page_token(token);
    request.set_show_deleted(deleted);
    v1::ListInstrumentsResponse response;
    const absl::Status status = ListStandard(call(), request, response);
    if (!status.ok()) return status;
    return response;
  }

  absl::StatusOr<v1::Instrument> Delete(const std::string& name, const std::string& etag = "") {
    v1::DeleteInstrumentRequest request;
    request.set_name(name);
    request.set_etag(etag);
    v1::Instrument made;
    const absl::Status status = DeleteStandard(call(), request, made);
    if (!status.ok()) return status;
    return made;
  }
};

// Would catch fields that the server sets and doesn't, or takes from a caller.
TEST_F(StandardTest, TheServerSetsItsFields) {
  v1::CreateInstrumentRequest request = Tracker();
  request.mutable_instrument()->set_uid("mine");
  const auto made = Create(request);
  ASSERT_THAT(made, IsOk());
  EXPECT_EQ(made->name(), "instruments/at960");
  EXPECT_EQ(made->serial(), "750123");
  EXPECT_EQ(made->uid().size(), 36u);
  EXPECT_GT(made->revision(), 0);
  EXPECT_FALSE(made->etag().empty());
  EXPECT_TRUE(made->has_create_time());
}

// Would catch a create that can't be repeated, or a second content under one name.
TEST_F(StandardTest, CreateIsRepeatable) {
  const auto first = Create(Tracker());
  EXPECT_EQ(Create(Tracker())->SerializeAsString(), first->SerializeAsString());
  v1::CreateInstrumentRequest other = Tracker();
  other.mutable_instrument()->set_serial("2");
  EXPECT_THAT(Create(other), HasCode(absl::StatusCode::kAlreadyExists));
}

// Would catch faults that are told one at a time, or without their path.
TEST_F(StandardTest, AllFaultsAtOnce) {
  v1::CreateInstrumentRequest request = Tracker();
  request.mutable_instrument()->set_position_sd_m(-1);
  request.mutable_instrument()->set_rotation_sd_rad(-1);
  EXPECT_THAT(Create(request),
              HasFaultsAt(Fields{"instrument.position_sd_m", "instrument.rotation_sd_rad"}));
  v1::CreatePoseSetRequest set;
  set.set_parent("ur10");
  set.set_pose_set_id("No");
  v1::PoseSet made;
  EXPECT_THAT(CreateStandard(call(), set, made), HasFaultsAt(Fields{"parent", "pose_set_id"}));
}

// Would catch a mask that is ignored, and an update over somebody else's.
TEST_F(StandardTest, UpdatesTouchTheMaskAndNeedTheirEtag) {
  const auto made = Create(Tracker());
  v1::UpdateInstrumentRequest request;
  request.mutable_instrument()->set_name(made->name());
  request.mutable_instrument()->set_etag(made->etag());
  request.mutable_instrument()->set_model("AT960");
  request.mutable_instrument()->set_serial("9");
  request.mutable_update_mask()->add_paths("model");
  const auto updated = Update(request);
  ASSERT_THAT(updated, IsOk());
  EXPECT_EQ(updated->model(), "AT960");
  EXPECT_EQ(updated->serial(), "750123");
  EXPECT_NE(updated->etag(), made->etag());
  request.mutable_instrument()->set_model("AT901");
  EXPECT_THAT(Update(request), HasCode(absl::StatusCode::kAborted));
  // A shell has taken the quotes away.
  const std::string etag = updated->etag();
  request.mutable_instrument()->set_etag(etag.substr(1, etag.size() - 2));
  EXPECT_THAT(Update(request), IsOk());
  request.mutable_update_mask()->add_paths("uid");
  request.mutable_update_mask()->add_paths("colour");
  request.mutable_instrument()->set_etag("");
  EXPECT_THAT(Update(request), HasFaultsAt(Fields{"update_mask", "update_mask"}));
}

// Would catch a masked field that is absent and stays.
TEST_F(StandardTest, AMaskedFieldThatIsAbsentIsCleared) {
  const auto made = Create(Tracker());
  v1::UpdateInstrumentRequest request;
  request.mutable_instrument()->set_name(made->name());
  request.mutable_update_mask()->add_paths("serial");
  EXPECT_EQ(Update(request)->serial(), "");
}

// Would catch a delete that destroys, shows in lists, or can't be taken back.
TEST_F(StandardTest, DeletedIsHiddenAndComesBack) {
  const auto made = Create(Tracker());
  EXPECT_THAT(Delete(made->name(), "stale"), HasCode(absl::StatusCode::kAborted));
  ASSERT_THAT(Delete(made->name(), made->etag()), IsOk());
  EXPECT_EQ(List("")->instruments_size(), 0);
  EXPECT_EQ(List("", 0, "", true)->instruments_size(), 1);
  EXPECT_THAT(Create(Tracker()), HasCode(absl::StatusCode::kAlreadyExists));
  v1::UndeleteInstrumentRequest request;
  request.set_name(made->name());
  v1::Instrument back;
  ASSERT_THAT(UndeleteStandard(call(), request, back), IsOk());
  EXPECT_FALSE(back.has_delete_time());
  EXPECT_EQ(List("")->instruments_size(), 1);
}

// Would catch pages that lose or repeat an item, count what the filter leaves out, or take another
// list's token.
TEST_F(StandardTest, PagesCountWhatTheFilterLeaves) {
  for (int i = 0; i < 9; ++i) {
    v1::CreateInstrumentRequest request = Tracker(absl::StrCat("i", i));
    request.mutable_instrument()->set_model(i % 2 == 0 ? "even" : "odd");
    ASSERT_THAT(Create(request), IsOk());
  }
  const std::string filter = "model = \"even\"";
  const auto first = List(filter, 3);
  ASSERT_THAT(first, IsOk());
  EXPECT_EQ(first->instruments_size(), 3);
  const auto second = List(filter, 3, first->next_page_token());
  ASSERT_THAT(second, IsOk());
  EXPECT_EQ(second->instruments_size(), 2);
  EXPECT_EQ(second->instruments(0).name(), "instruments/i6");
  EXPECT_EQ(second->next_page_token(), "");
  EXPECT_THAT(List("", 3, first->next_page_token()), HasFaultsAt(Fields{"page_token"}));
}

// Would catch a check that stores, or an answer that differs from the real one.
TEST_F(StandardTest, ValidateOnlyStoresNothing) {
  v1::CreateInstrumentRequest request = Tracker();
  request.set_validate_only(true);
  ASSERT_THAT(Create(request), IsOk());
  EXPECT_EQ(List("")->instruments_size(), 0);
}

// Would catch a second effect of a request that came several times at once, or two answers to it.
TEST_F(StandardTest, ARequestIdHasOneEffectAndOneAnswer) {
  const auto made = Create(Tracker());
  v1::UpdateInstrumentRequest request;
  request.mutable_instrument()->set_name(made->name());
  request.mutable_instrument()->set_model("AT960");
  request.mutable_update_mask()->add_paths("model");
  request.set_request_id(kJob1);
  std::vector<std::string> answers(5);
  std::vector<std::thread> threads;
  for (std::string& answer : answers) {
    threads.emplace_back([&] { answer = Update(request)->SerializeAsString(); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const std::string& answer : answers) EXPECT_EQ(answer, answers[0]);
  request.mutable_instrument()->set_model("AT901");
  EXPECT_THAT(Update(request), HasFaultsAt(Fields{"request_id"}));
}

// Would catch resources of one robot that show under another, and a robot that need not be there.
TEST_F(StandardTest, ResourcesOfARobotStayWithIt) {
  AddRobot("ur10");
  v1::CreatePlacementRequest request;
  request.set_parent("robots/ur10");
  request.set_placement_id("floor");
  request.mutable_placement()->set_instrument("instruments/at960");
  v1::Placement made;
  ASSERT_THAT(CreateStandard(call(), request, made), IsOk());
  EXPECT_EQ(made.name(), "robots/ur10/placements/floor");
  request.set_parent("robots/none");
  EXPECT_THAT(CreateStandard(call(), request, made), HasCode(absl::StatusCode::kNotFound));
}

// Would catch a version that counts changes of the name as changes of the tool.
TEST_F(StandardTest, AToolCountsChangesOfItsContent) {
  v1::CreateRegisteredToolRequest create;
  create.set_registered_tool_id("gripper");
  create.mutable_registered_tool()->mutable_pose()->set_qw(1);
  create.mutable_registered_tool()->set_mass_kg(2);
  v1::RegisteredTool tool;
  ASSERT_THAT(CreateStandard(call(), create, tool), IsOk());
  EXPECT_EQ(tool.version(), 1);
  v1::UpdateRegisteredToolRequest update;
  update.mutable_registered_tool()->set_name(tool.name());
  update.mutable_registered_tool()->set_display_name("Gripper");
  update.mutable_registered_tool()->set_mass_kg(3);
  update.mutable_update_mask()->add_paths("display_name");
  ASSERT_THAT(UpdateStandard(call(), update, tool), IsOk());
  EXPECT_EQ(tool.version(), 1);
  update.mutable_update_mask()->add_paths("mass_kg");
  ASSERT_THAT(UpdateStandard(call(), update, tool), IsOk());
  EXPECT_EQ(tool.version(), 2);
}

}  // namespace
}  // namespace truepose::services
