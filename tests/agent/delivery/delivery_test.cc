// From a spool to a real server that restarts, is restored from an older copy, or refuses.
#include "client/agent/delivery/delivery.h"

#include <filesystem>

#include "absl/strings/str_cat.h"
#include "client/agent/delivery/audit.h"
#include "client/pager.h"
#include "tests/agent/spool/spool_testing.h"
#include "tests/integration/server_fixture.h"
#include "tests/server/testing/examples.h"
#include "tests/server/testing/expect_status.h"

namespace truepose::agent {
namespace {

using testing::Content;
using testing::Numbered;
using testing::NumberOf;
using truepose::testing::IsOk;
using truepose::testing::Uuid;

std::string Name(int number) { return "sessions/" + Uuid(number); }

class DeliveryTest : public truepose::testing::ServerFixture {
 protected:
  DeliveryTest() : client_(NewClient()) {
    v1::CreateRobotRequest robot = truepose::testing::RobotRequest("arm");
    EXPECT_THAT(client_.CreateRobot(robot), IsOk());
    auto spool = Spool::Open({.folder = folder_.File("spool")}, disk_);
    EXPECT_THAT(spool, IsOk());
    spool_ = *std::move(spool);
  }
  void Start() {
    delivery_ = std::make_unique<Delivery>(
        *spool_, client_, DeliveryOptions{.refused_pause = std::chrono::milliseconds(50)},
        [this](const std::string& line) {
          std::lock_guard lock(mutex_);
          log_ += line + "\n";
        });
  }
  // Appends so that the session has `readings`, and seals.
  void Measure(int session, int readings, bool seal, const std::string& robot = "robots/arm") {
    v1::Session content = Content(Uuid(session));
    content.set_robot(robot);
    const auto file = spool_->Begin(content, "");
    ASSERT_THAT(file, IsOk());
    const int64_t has = (*file)->readings();
    ASSERT_THAT((*file)->Append(has + 1, Numbered(has + 1, readings)), IsOk());
    if (seal) {
      ASSERT_THAT((*file)->Seal(readings), IsOk());
    }
    if (delivery_ != nullptr) delivery_->Notify();
  }
  template <typename Condition>
  static bool WaitUntil(Condition condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  bool WaitUntilDone(int session) {
    return WaitUntil([&] { return spool_->IsDone(Name(session)); });
  }
  // The numbers that the server has, by row.
  std::vector<int64_t> Stored(int session) const {
    v1::ListReadingsRequest request;
    request.set_session(Name(session));
    std::vector<int64_t> numbers;
    EXPECT_THAT(client::ForEachPage(
                    request, [&](const auto& r) { return client_.ListReadings(r); },
                    [&](const v1::ListReadingsResponse& page) {
                      for (const auto& reading : page.readings())
                        numbers.push_back(NumberOf(reading));
                      return absl::OkStatus();
                    }),
                IsOk());
    return numbers;
  }
  static std::vector<int64_t> Upto(int64_t last) {
    std::vector<int64_t> numbers;
    for (int64_t number = 1; number <= last; ++number) numbers.push_back(number);
    return numbers;
  }

  truepose::testing::TempDir folder_;
  Disk disk_;
  const client::Client client_;
  std::unique_ptr<Spool> spool_;
  std::mutex mutex_;
  std::string log_;
  std::unique_ptr<Delivery> delivery_;
};

// Would catch sessions that were made offline and never get to the server, or get there mixed.
TEST_F(DeliveryTest, SessionsMadeOfflineAreCreatedFilledAndSealed) {
  Measure(1, 25, true);
  Measure(2, 2500, true);
  Start();
  ASSERT_TRUE(WaitUntilDone(1) && WaitUntilDone(2));
  EXPECT_EQ(Stored(1), Upto(25));
  EXPECT_EQ(Stored(2), Upto(2500));
  v1::GetSessionRequest get;
  get.set_name(Name(2));
  EXPECT_EQ(client_.GetSession(get)->state(), v1::SEALED);
  EXPECT_TRUE(spool_->Sessions().empty());
}

// Would catch readings that wait for their session's end.
TEST_F(DeliveryTest, AnOpenSessionIsDeliveredAsItGrows) {
  Start();
  for (int readings = 1; readings <= 5; ++readings) {
    Measure(1, readings, false);
    ASSERT_TRUE(WaitUntil([&] { return spool_->Find(Name(1))->delivered == readings; }));
  }
  EXPECT_EQ(Stored(1), Upto(5));
}

// Would catch a thread that gives up while the server is away.
TEST_F(DeliveryTest, GoesOnWhenTheServerIsBack) {
  Start();
  Measure(1, 5, false);
  ASSERT_TRUE(WaitUntil([&] { return spool_->Find(Name(1))->delivered == 5; }));
  EXPECT_TRUE(delivery_->state().connected);
  StopServer();
  Measure(1, 9, true);
  ASSERT_TRUE(WaitUntil([&] { return !delivery_->state().connected; }));
  EXPECT_FALSE(delivery_->state().problem.empty());
  Restart();
  ASSERT_TRUE(WaitUntilDone(1));
  EXPECT_EQ(Stored(1), Upto(9));
}

// Would catch readings, of open or done sessions, that a restored server lacks and never gets.
TEST_F(DeliveryTest, ARestoredServerGetsEverythingAgain) {
  Start();
  Measure(1, 30, false);
  ASSERT_TRUE(WaitUntil([&] { return spool_->Find(Name(1))->delivered == 30; }));
  StopServer();
  const std::string copy = folder_.File("copy");
  std::filesystem::copy_file(options_.database, copy);
  Restart();
  Measure(1, 40, true);
  Measure(2, 20, true);
  Measure(3, 10, false);
  ASSERT_TRUE(WaitUntilDone(1) && WaitUntilDone(2));
  ASSERT_TRUE(WaitUntil([&] { return spool_->Find(Name(3))->delivered == 10; }));
  StopServer();
  for (const char* suffix : {"", "-wal", "-shm"})
    std::filesystem::remove(options_.database + suffix);
  std::filesystem::copy_file(copy, options_.database);
  Restart();
  delivery_->DistrustServer();  // as the watch says that its connection broke
  ASSERT_TRUE(WaitUntil([&] { return delivery_->state().reopened_sessions == 2; }));
  ASSERT_TRUE(WaitUntilDone(1) && WaitUntilDone(2));
  ASSERT_TRUE(WaitUntil([&] { return spool_->Find(Name(3))->delivered == 10; }));
  EXPECT_EQ(Stored(1), Upto(40));
  EXPECT_EQ(Stored(2), Upto(20));
  EXPECT_EQ(Stored(3), Upto(10));
}

// Would catch a session that holds up all others, and a refusal that nobody is told of or that
// stands for ever.
TEST_F(DeliveryTest, ARefusedSessionHoldsUpNoOther) {
  Measure(1, 3, true, "robots/nobody");
  Measure(2, 3, true);
  Start();
  ASSERT_TRUE(WaitUntilDone(2));
  ASSERT_TRUE(WaitUntil([&] { return !spool_->Find(Name(1))->refusal().empty(); }));
  {
    std::lock_guard lock(mutex_);
    EXPECT_THAT(log_, ::testing::HasSubstr("robots/nobody"));
  }
  ASSERT_THAT(client_.CreateRobot(truepose::testing::RobotRequest("nobody")), IsOk());
  ASSERT_TRUE(WaitUntilDone(1));
}

// Would catch files that stay for ever, and one that goes though the server doesn't have it.
TEST_F(DeliveryTest, WhatWasKeptLongEnoughGoes) {
  Measure(1, 3, true);
  Start();
  ASSERT_TRUE(WaitUntilDone(1));
  delivery_.reset();
  for (const DoneSession& done : spool_->Done())
    EXPECT_EQ(*AuditDone(client_, *spool_, done, std::chrono::hours(1)), Audited::kKept);
  for (const DoneSession& done : spool_->Done())
    EXPECT_EQ(*AuditDone(client_, *spool_, done, std::chrono::seconds(-1)), Audited::kRemoved);
  EXPECT_EQ(spool_->used_bytes(), 0);
}

// Would catch a session that is taken away while its source is about to measure, and empty ones
// that pile up.
TEST_F(DeliveryTest, EmptySessionsGoAfterAWhile) {
  ASSERT_THAT(spool_->Begin(Content(Uuid(1)), ""), IsOk());
  EmptySince since;
  RemoveEmptySessions(*spool_, std::chrono::hours(1), since);
  ASSERT_EQ(spool_->Sessions().size(), 1u);
  RemoveEmptySessions(*spool_, std::chrono::seconds(-1), since);
  EXPECT_TRUE(spool_->Sessions().empty());
}

}  // namespace
}  // namespace truepose::agent
