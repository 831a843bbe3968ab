#include "client/agent/spool/spool.h"

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "client/agent/spool/crc32c.h"
#include "tests/agent/spool/spool_testing.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::agent {
namespace {

using testing::Content;
using testing::FaultyDisk;
using testing::Numbered;
using truepose::testing::HasCode;
using truepose::testing::IsOk;

std::string Id(int number) { return absl::StrCat("00000000-0000-4000-8000-00000000000", number); }
std::string Name(int number) { return "sessions/" + Id(number); }

class SpoolTest : public ::testing::Test {
 protected:
  SpoolTest() { Open(); }
  void Open() {
    spool_.reset();
    auto spool = Spool::Open({.folder = folder_.File("spool")}, disk_);
    ASSERT_THAT(spool, IsOk());
    spool_ = *std::move(spool);
  }
  Spool::Session Add(int number, int readings) {
    const auto session = spool_->Begin(Content(Id(number)), "");
    EXPECT_THAT(session, IsOk());
    if (readings > 0) {
      EXPECT_THAT((*session)->Append(1, Numbered(1, readings)), IsOk());
    }
    return *session;
  }
  std::string File(int number, const char* suffix) const {
    return folder_.File("spool/sessions/" + Id(number) + suffix);
  }

  truepose::testing::TempDir folder_;
  FaultyDisk disk_;
  std::unique_ptr<Spool> spool_;
};

// The check value of the polynomial's catalogue; would catch another polynomial or bit order.
TEST(Crc32cTest, CheckValue) {
  EXPECT_EQ(Crc32c("123456789"), 0xE3069283u);
  EXPECT_EQ(Crc32c("456789", Crc32c("123")), 0xE3069283u);
}

// Would catch sessions that a restart loses, or whose states it mixes up.
TEST_F(SpoolTest, AStartFindsEverySession) {
  Add(1, 3);
  ASSERT_THAT(Add(2, 2)->Seal(2), IsOk());
  ASSERT_THAT(Add(3, 4)->Seal(4), IsOk());
  ASSERT_THAT(spool_->SetDone(Name(3)), IsOk());
  const int64_t used = spool_->used_bytes();
  Open();
  EXPECT_TRUE(spool_->notes().empty());
  EXPECT_EQ(spool_->used_bytes(), used);
  ASSERT_EQ(spool_->Sessions().size(), 2u);
  EXPECT_EQ(spool_->Find(Name(1))->readings(), 3);
  EXPECT_FALSE(spool_->Find(Name(1))->sealed());
  EXPECT_TRUE(spool_->Find(Name(2))->sealed());
  EXPECT_EQ(spool_->Find(Name(3)), nullptr);
  ASSERT_EQ(spool_->Done().size(), 1u);
  const auto again = spool_->Reopen(Name(3));
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ((*again)->readings(), 4);
  EXPECT_EQ(spool_->used_bytes(), used);
}

// Would catch space that is never given back, which fills a spool for good.
TEST_F(SpoolTest, RemovedSessionsGiveTheirSpaceBack) {
  ASSERT_THAT(Add(1, 30)->Seal(30), IsOk());
  ASSERT_THAT(spool_->SetDone(Name(1)), IsOk());
  EXPECT_GT(spool_->used_bytes(), 0);
  ASSERT_THAT(spool_->Remove(Name(1)), IsOk());
  EXPECT_EQ(spool_->used_bytes(), 0);
  EXPECT_TRUE(spool_->Done().empty());
}

// Would catch a begin that is answered twice with two sessions, or that changes one.
TEST_F(SpoolTest, ABeginMayBeRepeated) {
  const auto first = Add(1, 2);
  v1::Session later = Content(Id(1));
  later.mutable_create_time()->set_seconds(99);
  EXPECT_EQ(*spool_->Begin(later, ""), first);
  later.set_operator_("ben");
  EXPECT_THAT(spool_->Begin(later, ""), HasCode(absl::StatusCode::kAlreadyExists));
}

// Would catch a reading that goes into a session which is taken away at the same moment.
TEST_F(SpoolTest, AnEmptySessionThatIsRemovedTakesNothingMore) {
  const auto session = Add(1, 0);
  ASSERT_THAT(spool_->RemoveEmpty(Name(1)), IsOk());
  EXPECT_THAT(session->Append(1, Numbered(1, 1)), HasCode(absl::StatusCode::kFailedPrecondition));
  Add(2, 1);
  EXPECT_THAT(spool_->RemoveEmpty(Name(2)), HasCode(absl::StatusCode::kFailedPrecondition));
}

// Would catch two agents that write into one spool.
TEST_F(SpoolTest, ASecondAgentIsRefusedByName) {
  const auto second = Spool::Open({.folder = folder_.File("spool")}, disk_);
  EXPECT_THAT(second, HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(std::string(second.status().message()),
              ::testing::HasSubstr(absl::StrCat("in use by process ", getpid())));
}

// Would catch a file of somebody else, or one that is damaged from its begin on, that keeps the
// agent from starting.
TEST_F(SpoolTest, WhatCantBeReadIsLeftAside) {
  Add(1, 3);
  spool_.reset();
  std::ofstream(File(2, ".spool")) << "TPSPOOL1 and then something else";
  std::ofstream(folder_.File("spool/sessions/notes.txt")) << "by hand";
  Open();
  EXPECT_EQ(spool_->notes().size(), 1u);
  EXPECT_EQ(spool_->Sessions().size(), 1u);
  EXPECT_TRUE(std::filesystem::exists(File(2, ".spool.unreadable")));
}

// Would catch a session that is removed early since the server was away for longer than it is kept.
TEST_F(SpoolTest, ASessionIsDoneFromItsSealOnTheServerOn) {
  ASSERT_THAT(Add(1, 2)->Seal(2), IsOk());
  using FileClock = std::filesystem::file_time_type::clock;
  std::filesystem::last_write_time(File(1, ".spool"), FileClock::now() - std::chrono::hours(240));
  const auto before = std::chrono::system_clock::now();
  ASSERT_THAT(spool_->SetDone(Name(1)), IsOk());
  // A file's time is kept in whole seconds, by a clock that ticks coarsely.
  EXPECT_GE(spool_->Done().at(0).sealed, before - std::chrono::seconds(2));
  Open();
  EXPECT_GE(spool_->Done().at(0).sealed, before - std::chrono::seconds(2)) << "after a start";
}

// Would catch a damaged session that is cut, or not told of, or in the way of its source.
TEST_F(SpoolTest, ADamagedSessionIsKeptWhole) {
  Add(1, 3);
  spool_.reset();
  const auto size = std::filesystem::file_size(File(1, ".spool"));
  std::fstream(File(1, ".spool"), std::ios::in | std::ios::out | std::ios::binary)
      .seekp(static_cast<int64_t>(size) - 120)
      .put('!');
  Open();
  EXPECT_EQ(spool_->notes().size(), 1u);
  EXPECT_EQ(std::filesystem::file_size(File(1, ".spool.unreadable")), size);
  Add(1, 3);
}

}  // namespace
}  // namespace truepose::agent
