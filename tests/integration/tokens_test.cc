// A server that asks for tokens: no RPC without one, revocation in calls and streams, and what the
// release makes of who calls.
#include <filesystem>

#include "absl/strings/str_cat.h"
#include "client/wait_for_job.h"
#include "grpcpp/impl/codegen/client_unary_call.h"
#include "server/auth/access_table.h"
#include "tests/integration/authenticated_fixture.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/examples.h"
#include "tests/server/testing/expect_status.h"
#include "truepose/v1/services.grpc.pb.h"
#include "truepose/v1/watch_services.grpc.pb.h"

namespace truepose {
namespace {

using testing::HasCode;
using testing::Import;
using testing::IsOk;
using testing::JobRequest;
using testing::MeasuringSession;
using testing::Uuid;

class TokensTest : public testing::AuthenticatedFixture {
 protected:
  // Any RPC with one empty message, streams too.
  grpc::Status CallWithNothing(const auth::AccessRow& row, const std::string& principal) const {
    grpc::ClientContext context;
    context.set_deadline(std::chrono::system_clock::now() + std::chrono::seconds(20));
    if (!principal.empty()) Show(principal, context);
    const std::string path =
        absl::StrCat("/", std::string(row.service), "/", std::string(row.method));
    const grpc::internal::RpcMethod method(path.c_str(), grpc::internal::RpcMethod::NORMAL_RPC);
    const grpc::Slice nothing;
    const grpc::ByteBuffer request(&nothing, 1);
    grpc::ByteBuffer reply;
    const auto channel = Channel();
    return grpc::internal::BlockingUnaryCall<grpc::ByteBuffer, grpc::ByteBuffer>(
        channel.get(), method, &context, request, &reply);
  }

  grpc::Status Approve(const std::string& principal, const std::string& calibration) const {
    v1::ApproveCalibrationRequest request;
    request.set_name(calibration);
    request.set_reason("a test");  // whatever the verdict
    grpc::ClientContext context;
    Show(principal, context);
    v1::Calibration reply;
    return v1::CalibrationService::NewStub(Channel())->ApproveCalibration(&context, request,
                                                                          &reply);
  }

  // A job of `principal` over session 1. @returns the calibration's name.
  std::string CalibrateAs(const std::string& principal, int job) const {
    const client::Client client = As(principal);
    v1::CreateCalibrationJobRequest request = JobRequest(Uuid(job), "arm", Uuid(1));
    // Equal content would be the calibration that is there.
    request.mutable_options()->set_split(absl::StrCat("random:", job, ":0.5"));
    EXPECT_THAT(client.CreateCalibrationJob(request), IsOk());
    const auto done = client::WaitForJob(client, absl::StrCat("jobs/", Uuid(job)));
    EXPECT_THAT(done, IsOk());
    return done->calibration();
  }
};

// Would catch an RPC that is bound without the door, unary or stream.
TEST_F(TokensTest, NoRpcIsServedWithoutAToken) {
  int closed = 0;
  for (const auth::AccessRow& row : auth::AccessTable()) {
    if (row.access == auth::Access::kEverybody) continue;
    const grpc::Status status = CallWithNothing(row, "");
    EXPECT_EQ(status.error_code(), grpc::StatusCode::UNAUTHENTICATED)
        << row.service << "/" << row.method << ": " << status.error_message();
    ++closed;
  }
  EXPECT_GT(closed, 70) << "most RPCs were not found";
}

// Would catch a level of access that no binding asks.
TEST_F(TokensTest, AMachineGetsNoFurtherThanTheTableSays) {
  for (const auth::AccessRow& row : auth::AccessTable()) {
    if (row.access != auth::Access::kPerson && row.access != auth::Access::kAdmin) continue;
    const grpc::Status status = CallWithNothing(row, "cell");
    EXPECT_EQ(status.error_code(), grpc::StatusCode::PERMISSION_DENIED)
        << row.service << "/" << row.method << ": " << status.error_message();
  }
}

// Would catch an RPC whose binding asks for another row than its own: it would be closed to all.
TEST_F(TokensTest, AnAdminMayCallEverything) {
  for (const auth::AccessRow& row : auth::AccessTable()) {
    if (row.method == "Watch") continue;  // has no end; ARevokedTokenEndsItsWatch calls it
    const grpc::Status status = CallWithNothing(row, "admin");
    EXPECT_NE(status.error_code(), grpc::StatusCode::PERMISSION_DENIED)
        << row.service << "/" << row.method << ": " << status.error_message();
    EXPECT_NE(status.error_code(), grpc::StatusCode::UNAUTHENTICATED) << row.method;
  }
}

// Would catch a token that is forgotten, or a revocation that is undone, by another start; and a
// bootstrap file that is still there.
TEST_F(TokensTest, AnotherStartKnowsTheSameTokens) {
  Revoke("ben");
  Restart();
  EXPECT_THAT(As("anna").ListRobots({}), IsOk());
  EXPECT_THAT(As("ben").ListRobots({}), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_THAT(As("").ListRobots({}), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_FALSE(std::filesystem::exists(options_.database + ".bootstrap"));
}

// Would catch a call whose answer got lost and whose repeat, after a restart too, leaves two
// tokens.
TEST_F(TokensTest, ARepeatMakesNoSecondToken) {
  v1::CreateTokenRequest request;
  request.set_request_id(Uuid(99));
  request.mutable_token()->set_principal("dora");
  request.mutable_token()->set_kind(v1::PERSON);
  const auto lost = As("admin").CreateToken(request);
  ASSERT_THAT(lost, IsOk());
  const int tokens = As("admin").ListTokens({})->tokens_size();
  Restart();
  const auto again = As("admin").CreateToken(request);
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(again->token().name(), lost->token().name());
  EXPECT_EQ(As("admin").ListTokens({})->tokens_size(), tokens);
  EXPECT_THAT(WithSecret(again->secret()).ListRobots({}), IsOk());
  EXPECT_THAT(WithSecret(lost->secret()).ListRobots({}),
              HasCode(absl::StatusCode::kUnauthenticated));
}

// Would catch a server that nobody can get into any more when all admins' tokens are lost.
TEST_F(TokensTest, AStartWithBootstrapLetsAnotherAdminIn) {
  options_.bootstrap = true;
  Restart();
  EXPECT_TRUE(std::filesystem::exists(options_.database + ".bootstrap"));
  EXPECT_THAT(As("anna").ListRobots({}), IsOk());
}

// Would catch a watch that goes on telling a revoked caller what happens in the plant.
TEST_F(TokensTest, ARevokedTokenEndsItsWatch) {
  grpc::ClientContext context;
  Show("ben", context);
  const auto stub = v1::WatchService::NewStub(Channel());
  const auto stream = stub->Watch(&context, v1::WatchRequest());
  v1::WatchResponse response;
  ASSERT_TRUE(stream->Read(&response)) << "the snapshot";
  Revoke("ben");
  ASSERT_THAT(As("anna").CreateRobot(testing::RobotRequest("later")), IsOk());
  while (stream->Read(&response)) {
    for (const v1::WatchEvent& event : response.events()) EXPECT_NE(event.name(), "robots/later");
  }
  EXPECT_EQ(stream->Finish().error_code(), grpc::StatusCode::UNAUTHENTICATED);
}

// Would catch readings that are still taken from a revoked machine because its stream was open.
TEST_F(TokensTest, ARevokedTokenEndsItsUpload) {
  ASSERT_THAT(As("anna").CreateRobot(testing::RobotRequest("ur10")), IsOk());
  ASSERT_THAT(As("cell").CreateSession(testing::SessionRequest(testing::kSession1, "robots/ur10")),
              IsOk());
  const client::Client client = As("cell");
  const auto stream = client.OpenAppendStream();
  ASSERT_TRUE(stream->Write(testing::Batch(testing::kSession1, 0, 2)));
  v1::AppendReadingsResponse acknowledgement;
  ASSERT_TRUE(stream->Read(&acknowledgement));
  Revoke("cell");
  stream->Write(testing::Batch(testing::kSession1, 2, 2));
  EXPECT_FALSE(stream->Read(&acknowledgement));
  EXPECT_THAT(stream->Finish(), HasCode(absl::StatusCode::kUnauthenticated));
  v1::ListReadingsRequest request;
  request.set_session(absl::StrCat("sessions/", testing::kSession1));
  EXPECT_EQ(As("anna").ListReadings(request)->readings_size(), 2);
}

// Would catch an approval by who made the job or sealed the session, by a machine, or one that is
// refused to the second person.
TEST_F(TokensTest, ASecondPersonApproves) {
  Import(As("cell"), "arm", Uuid(1), MeasuringSession(200, 1));
  const std::string of_anna = CalibrateAs("anna", 7);
  EXPECT_EQ(Approve("anna", of_anna).error_code(), grpc::StatusCode::PERMISSION_DENIED);
  EXPECT_EQ(Approve("cell", of_anna).error_code(), grpc::StatusCode::PERMISSION_DENIED);
  const grpc::Status ben = Approve("ben", of_anna);
  EXPECT_TRUE(ben.ok()) << ben.error_message();
  const std::string of_cell = CalibrateAs("cell", 8);
  ASSERT_NE(of_cell, of_anna);
  const grpc::Status anna = Approve("anna", of_cell);
  EXPECT_TRUE(anna.ok()) << "a machine's job needs one person: " << anna.error_message();
}

// Would catch a sealing operator who approves what was measured.
TEST_F(TokensTest, WhoSealedTheSessionDoesNotApprove) {
  Import(As("anna"), "arm", Uuid(1), MeasuringSession(200, 1));
  const std::string calibration = CalibrateAs("cell", 7);
  EXPECT_EQ(Approve("anna", calibration).error_code(), grpc::StatusCode::PERMISSION_DENIED);
  const grpc::Status ben = Approve("ben", calibration);
  EXPECT_TRUE(ben.ok()) << ben.error_message();
}

}  // namespace
}  // namespace truepose
