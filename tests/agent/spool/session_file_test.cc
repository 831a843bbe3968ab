#include "client/agent/spool/session_file.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

#include "core/base/error_metadata.h"
#include "tests/agent/spool/spool_testing.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::agent {
namespace {

using testing::Content;
using testing::FaultyDisk;
using testing::kSession;
using testing::Numbered;
using testing::NumberOf;
using truepose::testing::HasCode;
using truepose::testing::IsOk;

class SessionFileTest : public ::testing::Test {
 protected:
  std::unique_ptr<SessionFile> Create() {
    auto file = SessionFile::Create(disk_, budget_, path_, Content(kSession), "");
    EXPECT_THAT(file, IsOk());
    return *std::move(file);
  }
  std::unique_ptr<SessionFile> Open() {
    auto file = SessionFile::Open(disk_, budget_, path_);
    EXPECT_THAT(file, IsOk());
    return file.ok() ? *std::move(file) : nullptr;
  }
  static std::vector<int64_t> All(const SessionFile& file, int most) {
    std::vector<int64_t> numbers;
    while (static_cast<int64_t>(numbers.size()) < file.readings()) {
      const auto readings = file.Read(static_cast<int64_t>(numbers.size()) + 1, most);
      EXPECT_THAT(readings, IsOk());
      if (!readings.ok() || readings->empty()) return numbers;
      for (const v1::Reading& reading : *readings) numbers.push_back(NumberOf(reading));
    }
    return numbers;
  }
  static std::vector<int64_t> Upto(int64_t last) {
    std::vector<int64_t> numbers;
    for (int64_t number = 1; number <= last; ++number) numbers.push_back(number);
    return numbers;
  }

  truepose::testing::TempDir folder_;
  const std::string path_ = folder_.File(std::string(kSession) + ".spool");
  FaultyDisk disk_;
  Budget budget_{1 << 24};
};

// Would catch an index that is off by a step, in batches that end anywhere in one.
TEST_F(SessionFileTest, ReadsBackWhatWasAppended) {
  {
    const auto file = Create();
    for (int64_t first = 1; first <= 1000; first += 100)
      ASSERT_EQ(*file->Append(first, Numbered(first, first + 99)), first + 99);
    EXPECT_EQ(All(*file, 7), Upto(1000));
    EXPECT_EQ(NumberOf(file->Read(257, 1)->front()), 257);
    EXPECT_EQ(NumberOf(file->Read(256, 1)->front()), 256);
    EXPECT_EQ(NumberOf(file->Read(777, 1)->front()), 777);
    ASSERT_THAT(file->Seal(1000), IsOk());
  }
  const auto file = Open();
  EXPECT_EQ(file->content().robot(), "robots/arm");
  EXPECT_TRUE(file->sealed());
  EXPECT_EQ(All(*file, 1000), Upto(1000));
  EXPECT_THAT(file->Read(1001, 1), HasCode(absl::StatusCode::kOutOfRange));
}

// Would catch a reading that is doubled by a repeat, one that fills another's place, and a gap.
TEST_F(SessionFileTest, NumbersAreHeldTo) {
  const auto file = Create();
  ASSERT_THAT(file->Append(1, Numbered(1, 5)), IsOk());
  EXPECT_EQ(*file->Append(3, Numbered(3, 8)), 8);
  EXPECT_EQ(*file->Append(1, Numbered(1, 8)), 8);
  EXPECT_THAT(file->Append(4, Numbered(5, 6)), HasCode(absl::StatusCode::kAborted));
  const auto gap = file->Append(10, Numbered(10, 10));
  EXPECT_THAT(gap, HasCode(absl::StatusCode::kOutOfRange));
  EXPECT_EQ(ErrorMetadataOf(gap.status()), (ErrorMetadata{{"expected_number", "9"}}));
  // The last of these would catch an overflow, in a build that looks for it.
  for (const int64_t number : {int64_t{0}, int64_t{-1}, std::numeric_limits<int64_t>::min()})
    EXPECT_THAT(file->Append(number, Numbered(1, 1)), HasCode(absl::StatusCode::kOutOfRange));
  EXPECT_THAT(file->Seal(7), HasCode(absl::StatusCode::kInvalidArgument));
  ASSERT_THAT(file->Seal(8), IsOk());
  EXPECT_THAT(file->Seal(8), IsOk());
  EXPECT_EQ(*file->Append(8, Numbered(8, 8)), 8) << "a repeat after the seal";
  EXPECT_THAT(file->Append(9, Numbered(9, 9)), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(All(*file, 3), Upto(8));
}

// Would catch a reading that depends on who set its row or server_time, which the server gives.
TEST_F(SessionFileTest, WhatTheServerGivesIsNoContent) {
  const auto file = Create();
  ASSERT_THAT(file->Append(1, Numbered(1, 1)), IsOk());
  std::vector<v1::Reading> again = Numbered(1, 1);
  again[0].set_row(17);
  EXPECT_THAT(file->Append(1, again), IsOk());
}

// Would catch a start that fails or loses a whole reading, wherever a crash left the file's end,
// and one after which readings go on behind the torn bytes.
TEST_F(SessionFileTest, ATornEndIsCutAtEveryByte) {
  {
    const auto file = Create();
    ASSERT_THAT(file->Append(1, Numbered(1, 10)), IsOk());
  }
  const auto full = static_cast<int64_t>(std::filesystem::file_size(path_));
  const std::string copy = folder_.File("copy");
  std::filesystem::copy_file(path_, copy);
  int64_t last_whole = 10;
  for (int64_t size = full; last_whole > 6; --size) {
    std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(path_, static_cast<uintmax_t>(size));
    const auto file = Open();
    ASSERT_NE(file, nullptr);
    ASSERT_TRUE(file->readings() == last_whole || file->readings() == last_whole - 1);
    last_whole = file->readings();
    ASSERT_EQ(file->bytes() + file->cut_bytes(), size);
    ASSERT_EQ(*file->Append(last_whole + 1, Numbered(last_whole + 1, 12)), 12);
    ASSERT_EQ(All(*Open(), 100), Upto(12)) << size;
  }
}

// Would catch readings that were answered for and are cut since the disk can't be read for now.
TEST_F(SessionFileTest, WhatCantBeReadIsNotCut) {
  {
    const auto file = Create();
    ASSERT_THAT(file->Append(1, Numbered(1, 10)), IsOk());
  }
  const auto full = std::filesystem::file_size(path_);
  for (const off_t readable : {0, 4, 8, 20, 200, 500, static_cast<int>(full) - 1}) {
    disk_.readable = readable;
    EXPECT_THAT(SessionFile::Open(disk_, budget_, path_), HasCode(absl::StatusCode::kUnavailable));
    EXPECT_EQ(std::filesystem::file_size(path_), full) << readable;
  }
  disk_.readable = off_t{1} << 40;
  EXPECT_EQ(All(*Open(), 100), Upto(10));
}

// Would catch a torn end that is gone without its copy, and one copy that takes another's place.
TEST_F(SessionFileTest, NothingIsCutWithoutACopy) {
  {
    const auto file = Create();
    ASSERT_THAT(file->Append(1, Numbered(1, 3)), IsOk());
  }
  const auto tear = [&] { std::ofstream(path_, std::ios::app | std::ios::binary) << "torn"; };
  const auto whole = std::filesystem::file_size(path_);
  const std::string cut = folder_.File(std::string(kSession) + ".cut");
  tear();
  // The copy is written, synced, and its folder is.
  for (int countdown = 0; countdown < 3; ++countdown) {
    disk_.countdown = countdown;
    EXPECT_THAT(SessionFile::Open(disk_, budget_, path_),
                HasCode(absl::StatusCode::kResourceExhausted));
    EXPECT_EQ(std::filesystem::file_size(path_), whole + 4) << countdown;
    EXPECT_FALSE(std::filesystem::exists(cut)) << "half a copy";
  }
  disk_.countdown = 1 << 30;
  EXPECT_EQ(Open()->cut_bytes(), 4);
  tear();
  tear();
  EXPECT_EQ(Open()->cut_bytes(), 8);
  EXPECT_EQ(std::filesystem::file_size(cut), 4u);
  EXPECT_EQ(std::filesystem::file_size(cut + ".2"), 8u);
}

// Would catch a flipped bit that is sent to the server as a reading, and one in the middle for
// which readings behind it, which were answered for, are cut.
TEST_F(SessionFileTest, AFlippedBitEndsWhatIsWholeOrIsRefused) {
  int before_last = 0;
  {
    const auto file = Create();
    ASSERT_THAT(file->Append(1, Numbered(1, 3)), IsOk());
    before_last = static_cast<int>(file->bytes());
    ASSERT_THAT(file->Append(4, Numbered(4, 4)), IsOk());
  }
  const std::string copy = folder_.File("copy");
  std::filesystem::copy_file(path_, copy);
  const auto full = static_cast<int>(std::filesystem::file_size(path_));
  for (int at = before_last - 100; at < full; ++at) {
    std::filesystem::copy_file(copy, path_, std::filesystem::copy_options::overwrite_existing);
    {
      std::fstream bytes(path_, std::ios::in | std::ios::out | std::ios::binary);
      bytes.seekg(at);
      const int byte = bytes.get();
      bytes.seekp(at).put(static_cast<char>(byte ^ 0x10));
    }
    if (at < before_last) {
      ASSERT_THAT(SessionFile::Open(disk_, budget_, path_), HasCode(absl::StatusCode::kDataLoss));
      ASSERT_EQ(std::filesystem::file_size(path_), static_cast<uintmax_t>(full)) << at;
      continue;
    }
    const auto file = Open();
    ASSERT_EQ(All(*file, 9), Upto(3)) << at;
    ASSERT_GT(file->cut_bytes(), 0);
    ASSERT_TRUE(std::filesystem::exists(folder_.File(std::string(kSession) + ".cut")));
  }
}

// Would catch a reading that is lost, half stored or answered for when any call to the disk fails,
// and a file that can't go on when there is space again.
TEST_F(SessionFileTest, GoesOnWhenTheDiskHasSpaceAgain) {
  for (const int failures : {1, 2, 3, 4}) {
    for (int countdown = 0; countdown < 6; ++countdown) {
      std::filesystem::remove(path_);
      const auto file = Create();
      ASSERT_THAT(file->Append(1, Numbered(1, 3)), IsOk());
      disk_.countdown = countdown;
      disk_.failures = failures;
      int64_t has = 3;
      for (int attempt = 0; attempt < 10; ++attempt) {
        const auto appended = file->Append(has + 1, Numbered(has + 1, has + 5));
        if (appended.ok()) {
          has = *appended;
        } else {
          ASSERT_THAT(appended, HasCode(absl::StatusCode::kResourceExhausted));
        }
        ASSERT_EQ(file->readings(), has);
      }
      disk_.countdown = 1 << 30;
      ASSERT_GE(has, 3 + 5 * (10 - failures));
      ASSERT_EQ(All(*file, 4), Upto(has));
      ASSERT_EQ(All(*Open(), 4), Upto(has)) << failures << " " << countdown;
    }
  }
}

// Would catch a spool that drops something when it is full, or that keeps a session from its end.
TEST_F(SessionFileTest, AFullSpoolRefusesAndSeals) {
  Budget small(1000);
  {
    const auto made = SessionFile::Create(disk_, small, path_, Content(kSession), "");
    ASSERT_THAT(made, IsOk());
    const auto& file = *made;
    int64_t has = 0;
    while (true) {
      const auto appended = file->Append(has + 1, Numbered(has + 1, has + 1));
      if (!appended.ok()) {
        EXPECT_THAT(appended, HasCode(absl::StatusCode::kResourceExhausted));
        break;
      }
      has = *appended;
      ASSERT_LT(has, 20);
    }
    EXPECT_GT(has, 3);
    EXPECT_LE(small.used(), 1000);
    EXPECT_EQ(All(*file, 9), Upto(has));
    EXPECT_THAT(file->Seal(has), IsOk());
  }
  EXPECT_EQ(small.used(), 0);
}

// Would catch a seal that takes its place from the budget, which another session may have taken, or
// which has less than is on the disk.
TEST_F(SessionFileTest, ASealIsTakenBeyondTheLimit) {
  Budget small(1000);
  const auto file = SessionFile::Create(disk_, small, path_, Content(kSession), "");
  ASSERT_THAT(file, IsOk());
  ASSERT_THAT((*file)->Append(1, Numbered(1, 1)), IsOk());
  small.Take(1000);
  const int64_t used = small.used();
  EXPECT_THAT((*file)->Seal(1), IsOk());
  EXPECT_EQ(small.used(), used + 9) << "the header of a record";
}

// Would catch a session whose creation failed half way and that then can't be made any more.
TEST_F(SessionFileTest, ACreationThatFailsLeavesNothing) {
  for (int countdown = 0; countdown < 3; ++countdown) {
    disk_.countdown = countdown;
    disk_.failures = 1;
    EXPECT_FALSE(SessionFile::Create(disk_, budget_, path_, Content(kSession), "").ok());
    EXPECT_FALSE(std::filesystem::exists(path_));
    EXPECT_EQ(budget_.used(), 0);
  }
}

}  // namespace
}  // namespace truepose::agent
