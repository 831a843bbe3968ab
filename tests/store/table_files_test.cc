// How long the bytes of compensation tables are kept.
#include "server/store/table_files.h"

#include <gtest/gtest.h>

#include "server/store/checksum.h"
#include "server/store/compensation_tables.h"
#include "server/store/files.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"
#include "server/store/store.h"
#include "tests/store/testing/fake_clock.h"
#include "tests/store/testing/samples.h"

namespace truepose::store {
namespace {

constexpr char kBytes[] = "bytes of a table";

class TableFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    auto store = Store::Open({.path = ":memory:", .clock = &clock_});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
  }

  // A READY table with these bytes.
  void Add(int number, const std::string& bytes = kBytes) {
    v1::CompensationTable table;
    table.set_name(CompensationTableName("ur10", Uuid(number)));
    table.set_state(v1::TABLE_READY);
    table.set_sha256(Sha256Hex(bytes));
    Put(table);
    ASSERT_TRUE(
        store_->Write([&](Transaction& t) { return PutFile(t, table.sha256(), bytes); }).ok());
  }
  void SetDeleted(int number, bool deleted) {
    auto table = store_->Read(
        [&](Snapshot& s) { return GetTable(s, CompensationTableName("ur10", Uuid(number))); });
    ASSERT_TRUE(table.ok()) << table.status();
    table->clear_delete_time();
    if (deleted) *table->mutable_delete_time() = ToTimestamp(clock_.Now());
    Put(*table);
  }
  void Put(v1::CompensationTable table) {
    const absl::Status put = store_->Write([&](Transaction& transaction) -> absl::Status {
      const absl::Status status = PutTable(transaction, table);
      return status.ok() ? NoteTableFile(transaction, table) : status;
    });
    ASSERT_TRUE(put.ok()) << put;
  }

  // Files forgotten until there are no more.
  int Forget() {
    int count = 0;
    while (*store_->Read([&](Snapshot& s) { return HasFilesToForget(s, clock_.Now()); })) {
      EXPECT_TRUE(*store_->Write([](Transaction& t) { return ForgetFile(t); }));
      ++count;
    }
    EXPECT_FALSE(*store_->Write([](Transaction& t) { return ForgetFile(t); }));
    return count;
  }
  bool Has(const std::string& bytes = kBytes) {
    return *store_->Read([&](Snapshot& s) { return HasFile(s, Sha256Hex(bytes)); });
  }
  int64_t Count(const std::string& table) {
    return *store_->Read(
        [&](Snapshot& s) { return sql::QueryInt64(s.sql(), "SELECT COUNT(*) FROM " + table); });
  }

  FakeClock clock_;
  std::unique_ptr<Store> store_;
};

// Would catch bytes that are kept for ever, or that go while their table can still be brought back.
TEST_F(TableFiles, GoSevenDaysAfterTheDeletion) {
  Add(1);
  Add(2, "others");
  clock_.Advance(absl::Hours(24 * 30));
  EXPECT_EQ(Forget(), 0) << "tables that are there keep theirs";
  SetDeleted(1, true);
  clock_.Advance(kKeepDeletedFiles - absl::Seconds(1));
  EXPECT_EQ(Forget(), 0);
  clock_.Advance(absl::Seconds(1));
  EXPECT_EQ(Forget(), 1);
  EXPECT_FALSE(Has());
  EXPECT_TRUE(Has("others"));
  EXPECT_EQ(Count("file_pieces"), 1);
}

// Would catch bytes that a table needs which is there, or deleted later.
TEST_F(TableFiles, StayWhileAnotherTableHasThem) {
  Add(1);
  Add(2);
  SetDeleted(1, true);
  clock_.Advance(kKeepDeletedFiles);
  EXPECT_EQ(Forget(), 0);
  SetDeleted(2, true);
  clock_.Advance(kKeepDeletedFiles - absl::Seconds(1));
  EXPECT_EQ(Forget(), 0);
  clock_.Advance(absl::Seconds(1));
  EXPECT_EQ(Forget(), 1);
  EXPECT_FALSE(Has());
}

// Would catch a table that was brought back and loses its bytes all the same.
TEST_F(TableFiles, StayWhenTheTableIsBroughtBack) {
  Add(1);
  SetDeleted(1, true);
  clock_.Advance(absl::Hours(24));
  SetDeleted(1, false);
  clock_.Advance(absl::Hours(24 * 30));
  EXPECT_EQ(Forget(), 0);
  EXPECT_TRUE(Has());
}

// Would catch a table whose bytes went long ago and that keeps those of the same table, built anew.
TEST_F(TableFiles, BuiltAnewTheyGoAgain) {
  for (int number = 1; number <= 3; ++number) {
    Add(number);
    EXPECT_TRUE(Has());
    SetDeleted(number, true);
    clock_.Advance(kKeepDeletedFiles);
    EXPECT_EQ(Forget(), 1) << number;
  }
}

}  // namespace
}  // namespace truepose::store
