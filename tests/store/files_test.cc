// Files in pieces, and the names of tables.
#include "server/store/files.h"

#include <gtest/gtest.h>

#include "server/store/checksum.h"
#include "server/store/names.h"
#include "server/store/sql/query.h"
#include "server/store/store.h"
#include "tests/store/testing/samples.h"

namespace truepose::store {
namespace {

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    auto store = Store::Open({.path = ":memory:"});
    ASSERT_TRUE(store.ok()) << store.status();
    store_ = *std::move(store);
  }

  absl::Status Put(const std::string& bytes) {
    return store_->Write(
        [&](Transaction& transaction) { return PutFile(transaction, Sha256Hex(bytes), bytes); });
  }
  absl::StatusOr<std::string> Piece(const std::string& sha256, int64_t position) {
    return store_->Read([&](Snapshot& snapshot) { return ReadPiece(snapshot, sha256, position); });
  }
  int64_t Count(const std::string& table) {
    return *store_->Read([&](Snapshot& snapshot) {
      return sql::QueryInt64(snapshot.sql(), "SELECT COUNT(*) FROM " + table);
    });
  }

  std::unique_ptr<Store> store_;
};

// Differs from place to place, so that no two pieces are alike.
std::string Bytes(size_t size) {
  std::string bytes;
  for (size_t i = 0; i < size; ++i) bytes += static_cast<char>((i * 31 + i / 251) % 256);
  return bytes;
}

// Would catch bytes that are lost or doubled at the edges of pieces, at sizes around them.
TEST_F(Files, ComeBackPieceByPiece) {
  for (const size_t size :
       {size_t{0}, size_t{1}, kPieceBytes - 1, kPieceBytes, kPieceBytes + 1, 3 * kPieceBytes + 7}) {
    const std::string bytes = Bytes(size);
    ASSERT_TRUE(Put(bytes).ok());
    std::string read;
    for (int64_t position = 0;; ++position) {
      const auto piece = Piece(Sha256Hex(bytes), position);
      ASSERT_TRUE(piece.ok()) << piece.status();
      if (piece->empty()) break;
      EXPECT_LE(piece->size(), kPieceBytes);
      read += *piece;
    }
    EXPECT_EQ(read, bytes) << size;
  }
}

// Would catch a second copy of the same bytes.
TEST_F(Files, EqualBytesAreStoredOnce) {
  const std::string bytes = Bytes(2 * kPieceBytes);
  ASSERT_TRUE(Put(bytes).ok());
  ASSERT_TRUE(Put(bytes).ok());
  EXPECT_EQ(Count("files"), 1);
  EXPECT_EQ(Count("file_pieces"), 2);
}

TEST_F(Files, OneThatIsNotThereIsNotFound) {
  EXPECT_TRUE(absl::IsNotFound(Piece(Sha256Hex("never stored"), 0).status()));
}

// Would catch a name that is read as another resource's, and two names of one table.
TEST(TableNames, AreReadAsTheyAreMade) {
  const std::string name = CompensationTableName("ur10", Uuid(7));
  EXPECT_EQ(*ParseTableName(name), (TableName{"ur10", Uuid(7)}));
  for (const std::string& wrong : {std::string("robots/ur10/compensationTables/7"), name + "/x",
                                   std::string("robots/ur10/calibrations/1"),
                                   "compensationTables/" + Uuid(7), std::string()}) {
    EXPECT_EQ(FaultFields(ParseTableName(wrong, "here").status()), std::vector<std::string>{"here"})
        << wrong;
  }
}

}  // namespace
}  // namespace truepose::store
