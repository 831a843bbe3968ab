#include "client/status.h"

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "gtest/gtest.h"
#include "server/rpc/status.h"

namespace truepose::client {
namespace {

absl::Status OverTheWire(const absl::Status& status) {
  return FromGrpcStatus(rpc::ToGrpcStatus(status, rpc::ErrorBytes(kErrorBytes)), "127.0.0.1:7878");
}

absl::Status Faulty(absl::StatusCode code, int count) {
  FaultList faults;
  for (int i = 0; i < count; ++i)
    faults.Add(absl::StrCat("readings[", i, "]"), absl::StrCat(i, " rad"), "< 0 rad");
  return faults.ToStatus(code);
}

TEST(StatusTest, OkStaysOk) { EXPECT_TRUE(OverTheWire(absl::OkStatus()).ok()); }

// Would catch a remote run that prints other lines than a local one.
TEST(StatusTest, FaultsArriveAsTheyWereSent) {
  FaultList faults;
  faults.Add("a", "1", "2");
  faults.Add("b.c[3]", "nothing to compare with", "");
  faults.Add("d", "found text, expected by nobody", "none");
  const absl::Status sent = faults.ToStatus(absl::StatusCode::kFailedPrecondition);
  const absl::Status got = OverTheWire(sent);
  EXPECT_EQ(got.code(), sent.code());
  EXPECT_EQ(got.message(), sent.message());
  const auto before = FaultsOf(sent), after = FaultsOf(got);
  ASSERT_EQ(after.size(), before.size());
  EXPECT_EQ(after[0], before[0]);
  EXPECT_EQ(after[1], before[1]);
  for (size_t i = 0; i < before.size(); ++i) EXPECT_EQ(ToString(after[i]), ToString(before[i]));
}

// Would catch a bound that cuts what fault.h keeps: 200 faults and the count of the rest.
TEST(StatusTest, AllKeptFaultsArrive) {
  const absl::Status sent = Faulty(absl::StatusCode::kInvalidArgument, 250);
  const absl::Status got = OverTheWire(sent);
  EXPECT_EQ(FaultsOf(got), FaultsOf(sent));
  EXPECT_EQ(got.message(), sent.message());
  EXPECT_NE(std::string(got.message()).find("and 50 more"), std::string::npos);
}

TEST(StatusTest, StatusWithoutFaultsHasNone) {
  const absl::Status got = OverTheWire(absl::NotFoundError("robots/none"));
  EXPECT_EQ(got, absl::NotFoundError("robots/none"));
  EXPECT_TRUE(FaultsOf(got).empty());
}

// Would catch a person who is told "Socket closed" and not which server, or a busy server that is
// called absent.
TEST(StatusTest, AnAbsentServerIsNamedByItsAddress) {
  const grpc::Status absent(grpc::StatusCode::UNAVAILABLE, "connection refused");
  const absl::Status got = FromGrpcStatus(absent, "127.0.0.1:7878");
  EXPECT_EQ(got.code(), absl::StatusCode::kUnavailable);
  EXPECT_EQ(got.message(), "no Truepose server answers at 127.0.0.1:7878 (connection refused)");
  EXPECT_EQ(OverTheWire(absl::UnavailableError("too busy")).message(), "too busy");
}

// Would catch an upload that gives up because a server that stops resets its calls.
TEST(StatusTest, ACallThatWasResetIsUnavailable) {
  const grpc::Status reset(grpc::StatusCode::CANCELLED, "CANCELLED");
  EXPECT_TRUE(absl::IsUnavailable(FromGrpcStatus(reset, "x")));
  EXPECT_TRUE(absl::IsCancelled(OverTheWire(absl::CancelledError("said by the server"))));
}

// Would catch a crash on what another server or a proxy sends.
TEST(StatusTest, DetailsThatCannotBeReadAreLeftOut) {
  for (const std::string& details :
       {std::string("\xFF\xFF\xFF"), std::string(1000, '\n'), std::string("text")}) {
    const absl::Status got =
        FromGrpcStatus(grpc::Status(grpc::StatusCode::INTERNAL, "broken", details), "x");
    EXPECT_EQ(got, absl::InternalError("broken"));
  }
}

}  // namespace
}  // namespace truepose::client
