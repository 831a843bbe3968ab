#include "server/rpc/status.h"

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "google/rpc/error_details.pb.h"
#include "google/rpc/status.pb.h"
#include "gtest/gtest.h"

namespace truepose::rpc {
namespace {

struct Details {
  google::rpc::Status status;
  google::rpc::ErrorInfo info;
  google::rpc::BadRequest bad_request;
};

Details Read(const grpc::Status& status) {
  Details details;
  EXPECT_TRUE(details.status.ParseFromString(status.error_details()));
  for (const auto& any : details.status.details()) {
    EXPECT_TRUE(any.UnpackTo(&details.info) || any.UnpackTo(&details.bad_request))
        << any.type_url();
  }
  return details;
}

absl::Status ManyFaults(int count) {
  FaultList faults;
  for (int i = 0; i < count; ++i)
    faults.Add(absl::StrCat("readings[", i, "].row"), "a wrong row", "a right row");
  return faults.ToStatus();
}

TEST(StatusTest, OkStaysOk) { EXPECT_TRUE(ToGrpcStatus(absl::OkStatus()).ok()); }

// Would catch a code that reaches the client as another one.
TEST(StatusTest, EveryCodeKeepsItsNumber) {
  for (int code = 1; code <= 16; ++code) {
    const absl::Status status(static_cast<absl::StatusCode>(code), "text");
    EXPECT_EQ(ToGrpcStatus(status).error_code(), code);
    EXPECT_EQ(Read(ToGrpcStatus(status)).status.code(), code);
  }
}

// Would catch an error that a program can't tell apart.
TEST(StatusTest, EveryErrorHasAReasonInOurDomain) {
  const Details details = Read(ToGrpcStatus(absl::NotFoundError("robots/none")));
  EXPECT_EQ(details.info.reason(), "NOT_FOUND");
  EXPECT_EQ(details.info.domain(), "truepose");
  EXPECT_EQ(details.bad_request.field_violations_size(), 0);
}

// Would catch a fault that is dropped or loses what was found and expected.
TEST(StatusTest, FaultsAreFieldViolations) {
  FaultList faults;
  faults.Add("robot_id", "'UR 10'", "[a-z0-9-]");
  faults.Add("nominal", "no joints", "");
  const grpc::Status status = ToGrpcStatus(faults.ToStatus());
  EXPECT_EQ(status.error_message(),
            "robot_id: found 'UR 10', expected [a-z0-9-]\nnominal: no joints");
  const Details details = Read(status);
  ASSERT_EQ(details.bad_request.field_violations_size(), 2);
  EXPECT_EQ(details.bad_request.field_violations(0).field(), "robot_id");
  EXPECT_EQ(details.bad_request.field_violations(0).description(),
            "found 'UR 10', expected [a-z0-9-]");
  EXPECT_EQ(details.bad_request.field_violations(1).description(), "no joints");
}

// Would catch an answer that an ordinary client can't receive (8 KiB of metadata), or a silent loss
// of faults.
TEST(StatusTest, SizeIsBoundedAndWhatIsLeftOutIsCounted) {
  for (const size_t most : {kDefaultErrorBytes, kMostErrorBytes}) {
    const grpc::Status status = ToGrpcStatus(ManyFaults(180), most);
    EXPECT_LE(status.error_message().size() + status.error_details().size(), most);
    const Details details = Read(status);
    const int kept = details.bad_request.field_violations_size();
    EXPECT_GT(kept, 30);
    const std::string left_out = kept < 180 ? absl::StrCat(180 - kept) : "";
    const auto found = details.info.metadata().find("more_faults");
    EXPECT_EQ(found == details.info.metadata().end() ? "" : found->second, left_out);
  }
}

// Would catch a message that is cut within a character, which no client could print.
TEST(StatusTest, LongMessagesAreCutBetweenCharacters) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += "\xC2\xB5";
  for (size_t most : {1000, 1001, 1002, 1003}) {
    const std::string message = ToGrpcStatus(absl::InternalError(text), most).error_message();
    EXPECT_TRUE(message.ends_with("\xC2\xB5...")) << message.substr(message.size() - 6);
  }
}

// Would catch a client that makes the server send more than it means to, or less than everybody
// gets.
TEST(StatusTest, CallersChooseWithinBounds) {
  EXPECT_EQ(ErrorBytes("20000"), 20'000u);
  EXPECT_EQ(ErrorBytes("99999999"), kMostErrorBytes);
  EXPECT_EQ(ErrorBytes("1"), kDefaultErrorBytes);
  EXPECT_EQ(ErrorBytes("-1"), kDefaultErrorBytes);
  EXPECT_EQ(ErrorBytes("many"), kDefaultErrorBytes);
}

}  // namespace
}  // namespace truepose::rpc
