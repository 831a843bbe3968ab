// What an agent takes as its released set, and what it refuses.
#include "client/agent/released/released_store.h"

#include <atomic>
#include <filesystem>
#include <fstream>
#include <thread>

#include "absl/strings/str_cat.h"
#include "compensation/correct_by_table.h"
#include "gmock/gmock.h"
#include "tests/agent/released/test_table.h"
#include "tests/agent/spool/spool_testing.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::agent {
namespace {

using ::testing::HasSubstr;
using testing::TestTable;
using truepose::testing::HasCode;
using truepose::testing::IsOk;

constexpr compensation::JointArray kJoints = {0.1, -1.2, 1.3, -1.6, -1.5, 0.2};

class ReleasedStoreTest : public ::testing::Test {
 protected:
  ReleasedStoreTest() { Restart(); }
  // Another process on the same folder.
  void Restart() {
    store_ =
        std::make_unique<ReleasedStore>(ReleasedCache(folder_.File("arm"), "robots/arm", disk_),
                                        [this](const std::string& line) { log_ += line + "\n"; });
    store_->Load();
  }
  absl::Status Offer(const TestTable& table) {
    return store_->Offer(table.entry, [&]() -> absl::StatusOr<std::string> {
      ++fetched_;
      return table.bytes;
    });
  }
  // A server that is away.
  absl::Status OfferFromCache(const TestTable& table) {
    return store_->Offer(table.entry, []() -> absl::StatusOr<std::string> {
      return absl::UnavailableError("away");
    });
  }
  std::string Running() const {
    const auto state = store_->state();
    return state->current == nullptr ? "" : state->current->entry().calibration;
  }
  std::string Problem() const { return store_->state()->problem; }
  std::string PathOf(const TestTable& table) const {
    return folder_.File("arm/" + table.entry.sha256 + ".table");
  }
  static void FlipByte(const std::string& path, int64_t at) {
    std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
    file.seekg(at);
    const char byte = static_cast<char>(file.get());
    file.seekp(at);
    file.put(static_cast<char>(byte ^ 1));
  }

  truepose::testing::TempDir folder_;
  testing::FaultyDisk disk_;
  std::string log_;
  int fetched_ = 0;
  std::unique_ptr<ReleasedStore> store_;
  const TestTable first_{1}, second_{2}, third_{3};
};

// Would catch a set that is not swapped, or that a start without a server does not find.
TEST_F(ReleasedStoreTest, TheLatestRunsAndOutlastsTheProcess) {
  ASSERT_THAT(Offer(first_), IsOk());
  ASSERT_THAT(Offer(second_), IsOk());
  EXPECT_EQ(Running(), "robots/arm/calibrations/2");
  Restart();
  EXPECT_EQ(Running(), "robots/arm/calibrations/2");
  ASSERT_EQ(store_->state()->former.size(), 1U);
  EXPECT_EQ(store_->state()->former[0]->entry(), first_.entry);
  EXPECT_EQ(Problem(), "");
}

// Would catch a path that others open and that is left at another table.
TEST_F(ReleasedStoreTest, OthersOpenWhatRuns) {
  for (const TestTable* table : {&first_, &second_}) {
    ASSERT_THAT(Offer(*table), IsOk());
    compensation::TableFile file;
    ASSERT_TRUE(compensation::TableFile::Map(store_->state()->path.c_str(), {}, &file).ok());
    EXPECT_EQ(file.table().header.calibration.view(), table->entry.calibration);
  }
}

// Would catch a path that stays at the table before, for a process that ended between the list and
// the link.
TEST_F(ReleasedStoreTest, AStartMendsThePathThatOthersOpen) {
  ASSERT_THAT(Offer(first_), IsOk());
  ASSERT_THAT(Offer(second_), IsOk());
  const std::string path = store_->state()->path;
  std::filesystem::remove(path);
  std::filesystem::create_symlink(first_.entry.sha256 + ".table", path);
  Restart();
  EXPECT_EQ(std::filesystem::read_symlink(path), second_.entry.sha256 + ".table");
  EXPECT_EQ(Problem(), "");
}

// Would catch a file that a server lets an agent write anywhere.
TEST_F(ReleasedStoreTest, ADigestThatIsNoneBecomesNoFile) {
  TestTable table = first_;
  table.entry.sha256 = "../../elsewhere";
  EXPECT_THAT(Offer(table), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(fetched_, 0);
  EXPECT_THAT(Problem(), HasSubstr("../../elsewhere"));
}

// Would catch a reader whose table goes away under it.
TEST_F(ReleasedStoreTest, WhoHoldsASetMayUseIt) {
  ASSERT_THAT(Offer(first_), IsOk());
  const auto held = store_->state();
  for (int number = 2; number <= 7; ++number) ASSERT_THAT(Offer(TestTable(number)), IsOk());
  EXPECT_FALSE(std::filesystem::exists(PathOf(first_))) << "the cache keeps a few only";
  EXPECT_EQ(compensation::CorrectByTable(held->current->table(), kJoints.data()).outcome,
            compensation::Outcome::kOk);
  EXPECT_EQ(store_->state()->former.size(), kFormerSets);
}

// Would catch a server that was restored from an older copy and takes its agents back with it.
TEST_F(ReleasedStoreTest, AnOlderRevisionIsRefused) {
  ASSERT_THAT(Offer(first_), IsOk());
  ASSERT_THAT(Offer(second_), IsOk());
  EXPECT_THAT(Offer(first_), HasCode(absl::StatusCode::kOutOfRange));
  EXPECT_EQ(Running(), "robots/arm/calibrations/2");
  EXPECT_THAT(Problem(), HasSubstr("older than calibrations/2"));
  EXPECT_THAT(log_, HasSubstr("refused calibrations/1"));
}

// Would catch a roll back that is taken for an older revision, or that needs the network though the
// table is there.
TEST_F(ReleasedStoreTest, ARollBackIsTakenFromTheCache) {
  ASSERT_THAT(Offer(first_), IsOk());
  ASSERT_THAT(Offer(second_), IsOk());
  TestTable back(1);
  back.entry.activated_us = second_.entry.activated_us + 1;
  back.entry.revision = second_.entry.revision + 1;
  ASSERT_THAT(OfferFromCache(back), IsOk());
  EXPECT_EQ(Running(), "robots/arm/calibrations/1");
  ASSERT_EQ(store_->state()->former.size(), 1U);
  EXPECT_EQ(store_->state()->former[0]->entry().calibration, "robots/arm/calibrations/2");
}

// Would catch bytes that are used because nobody looked at them: from the network and on the disk.
TEST_F(ReleasedStoreTest, AFlippedByteIsNoticed) {
  ASSERT_THAT(Offer(first_), IsOk());
  TestTable broken(2);
  broken.bytes[broken.bytes.size() / 2] ^= 1;
  EXPECT_THAT(Offer(broken), HasCode(absl::StatusCode::kDataLoss));
  EXPECT_EQ(Running(), "robots/arm/calibrations/1") << "the last good one stays";
  EXPECT_THAT(Problem(), HasSubstr("damaged"));
  EXPECT_FALSE(std::filesystem::exists(PathOf(broken)));

  FlipByte(PathOf(first_), 7'600);
  Restart();
  EXPECT_EQ(Running(), "");
  EXPECT_THAT(Problem(), HasSubstr("calibrations/1 is not used: damaged"));
  fetched_ = 0;
  ASSERT_THAT(Offer(first_), IsOk());
  EXPECT_EQ(fetched_, 1);
  EXPECT_EQ(Running(), "robots/arm/calibrations/1");
  EXPECT_EQ(Problem(), "");
}

// Would catch another robot's table that is run, however it came.
TEST_F(ReleasedStoreTest, AnotherRobotsTableIsRefused) {
  ASSERT_THAT(Offer(first_), IsOk());
  const TestTable other(2, "robots/other");
  TestTable named_so = other;
  named_so.entry = second_.entry;
  EXPECT_THAT(Offer(named_so), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(Offer(other), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(Problem(), HasSubstr("another robot's: found robots/other"));
  TestTable other_arm(2);
  other_arm.entry.serial = "B-1";
  EXPECT_THAT(Offer(other_arm), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(Problem(), HasSubstr("serial: found 'A-17', expected 'B-1'"));
  EXPECT_EQ(Running(), "robots/arm/calibrations/1");
}

// Would catch an agent that fetches for ever what it will never take, and one that gives up what
// another try may bring.
TEST_F(ReleasedStoreTest, FetchesAgainWhatMayChange) {
  const TestTable other(1, "robots/other");
  for (int attempt = 0; attempt < 3; ++attempt)
    EXPECT_THAT(Offer(other), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(fetched_, 1);
  for (const auto code : {absl::StatusCode::kFailedPrecondition, absl::StatusCode::kAborted}) {
    const auto failing = [&]() -> absl::StatusOr<std::string> {
      return absl::Status(code, "not now");
    };
    EXPECT_THAT(store_->Offer(first_.entry, failing), HasCode(absl::StatusCode::kUnavailable));
    EXPECT_THAT(Problem(), HasSubstr("not now"));
  }
  EXPECT_THAT(Offer(first_), IsOk());
  EXPECT_EQ(Problem(), "");
}

// Would catch a file that somebody put into the cache and that is believed.
TEST_F(ReleasedStoreTest, FilesPutIntoTheCacheAreRefused) {
  ASSERT_THAT(Offer(second_), IsOk());
  const TestTable other(2, "robots/other");
  std::ofstream(PathOf(second_), std::ios::binary | std::ios::trunc) << other.bytes;
  Restart();
  EXPECT_EQ(Running(), "");
  EXPECT_THAT(Problem(), HasSubstr("calibrations/2 is not used"));

  std::ofstream(PathOf(second_), std::ios::binary | std::ios::trunc) << first_.bytes;
  Restart();
  EXPECT_EQ(Running(), "") << "an older revision's";
  EXPECT_THAT(Problem(), HasSubstr("another calibration"));

  std::ofstream(folder_.File("arm/released.json")) << ToJson("robots/other", {other.entry});
  Restart();
  EXPECT_EQ(Running(), "");
  EXPECT_THAT(Problem(), HasSubstr("is of robots/other, expected robots/arm"));
  std::ofstream(folder_.File("arm/released.json")) << "{\"robot\":";
  Restart();
  EXPECT_THAT(Problem(), HasSubstr("released.json"));
}

// Would catch a full disk that leaves half a set, or readers of another one than the next start's.
TEST_F(ReleasedStoreTest, AFullDiskLeavesTheLastOne) {
  ASSERT_THAT(Offer(first_), IsOk());
  for (int calls = 0;; ++calls) {
    disk_.countdown = calls;
    const absl::Status status = Offer(second_);
    disk_.countdown = 1 << 30;
    if (status.ok()) break;
    EXPECT_EQ(Running(), "robots/arm/calibrations/1") << calls;
    EXPECT_THAT(Problem(), HasSubstr("refused calibrations/2"));
    ReleasedStore next(ReleasedCache(folder_.File("arm"), "robots/arm", disk_),
                       [](const std::string&) {});
    next.Load();
    ASSERT_NE(next.state()->current, nullptr) << calls << next.state()->problem;
  }
  EXPECT_EQ(Running(), "robots/arm/calibrations/2");
  EXPECT_EQ(Problem(), "");
}

// Would catch a reader that sees half of a swap: a table with another one's name or numbers.
TEST_F(ReleasedStoreTest, ReadersDuringAThousandSwaps) {
  TestTable tables[] = {TestTable(1), TestTable(2)};
  ASSERT_THAT(Offer(tables[0]), IsOk());
  ASSERT_THAT(Offer(tables[1]), IsOk());
  compensation::JointArray expected[2];
  for (int i = 0; i < 2; ++i)
    expected[i] =
        compensation::CorrectByTable(compensation::MakeTable(tables[i].content), kJoints.data()).q;
  ASSERT_NE(expected[0], expected[1]);
  std::atomic<bool> ended{false};
  std::atomic<int64_t> reads{0}, wrong{0};
  std::vector<std::thread> readers;
  for (int reader = 0; reader < 4; ++reader)
    readers.emplace_back([&] {
      while (!ended) {
        const auto state = store_->state();
        const int which =
            state->current->entry().calibration == tables[0].entry.calibration ? 0 : 1;
        const auto found = compensation::CorrectByTable(state->current->table(), kJoints.data());
        if (found.q != expected[which]) ++wrong;
        ++reads;
      }
    });
  for (int swap = 0; swap < 1'000; ++swap) {
    TestTable& next = tables[swap % 2];
    next.entry.activated_us = 1'790'000'000'000'000 + swap;
    ASSERT_THAT(OfferFromCache(next), IsOk());
  }
  ended = true;
  for (std::thread& reader : readers) reader.join();
  EXPECT_EQ(wrong, 0);
  EXPECT_GE(reads, 1'000);
}

}  // namespace
}  // namespace truepose::agent
