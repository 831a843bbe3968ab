// What is kept of the server's requests.
#include "client/agent/requests/request_book.h"

#include "gmock/gmock.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::agent {
namespace {

using truepose::testing::IsOk;

constexpr char kRobot[] = "robots/arm";

v1::RecalibrationRequest Request(v1::RecalibrationState state, int64_t revision) {
  v1::RecalibrationRequest request;
  request.set_name("robots/arm/recalibrationRequests/1");
  request.set_state(state);
  request.set_revision(revision);
  return request;
}

class RequestBookTest : public ::testing::Test {
 protected:
  RequestBookTest() { Restart(); }
  void Restart() {
    auto book = RequestBook::Open(folder_.File("requests"), disk_, {kRobot});
    ASSERT_THAT(book, IsOk());
    book_ = *std::move(book);
  }
  v1::RecalibrationState State() const {
    const auto open = book_->Find(kRobot);
    return open.has_value() ? open->request.state() : v1::RECALIBRATION_STATE_UNSPECIFIED;
  }

  truepose::testing::TempDir folder_;
  Disk disk_;
  std::unique_ptr<RequestBook> book_;
};

// Would catch a late answer that sets a request back.
TEST_F(RequestBookTest, WhatIsOutOfDateIsNotTaken) {
  ASSERT_THAT(book_->Take(kRobot, Request(v1::REQUEST_MEASURING, 9)), IsOk());
  ASSERT_THAT(book_->Take(kRobot, Request(v1::REQUEST_PENDING, 8)), IsOk());
  EXPECT_EQ(State(), v1::REQUEST_MEASURING);
}

// Would catch an agent that does nothing for a request of a server that was restored from an older
// copy, since it has seen higher revisions, in this process or the one before.
TEST_F(RequestBookTest, ASnapshotOfARestoredServerIsTaken) {
  ASSERT_THAT(book_->Take(kRobot, Request(v1::REQUEST_MEASURING, 9)), IsOk());
  Restart();
  ASSERT_THAT(book_->Take(kRobot, Request(v1::REQUEST_PENDING, 5), /*is_snapshot=*/true), IsOk());
  EXPECT_EQ(State(), v1::REQUEST_PENDING);
  ASSERT_THAT(book_->Take(kRobot, Request(v1::REQUEST_ACKNOWLEDGED, 6)), IsOk());
  EXPECT_EQ(State(), v1::REQUEST_ACKNOWLEDGED);
}

}  // namespace
}  // namespace truepose::agent
