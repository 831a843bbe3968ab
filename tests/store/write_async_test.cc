// Writes whose callers don't wait.
#include <gtest/gtest.h>

#include <future>
#include <memory>
#include <vector>

#include "absl/synchronization/notification.h"
#include "server/store/sql/query.h"
#include "server/store/store.h"
#include "tests/store/testing/samples.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::store {
namespace {

class WriteAsync : public ::testing::Test {
 protected:
  void SetUp() override {
    auto opened = Store::Open({.path = folder_.Path("store.db")});
    ASSERT_TRUE(opened.ok()) << opened.status();
    store_ = *std::move(opened);
  }

  TemporaryFolder folder_;
  std::unique_ptr<Store> store_;
};

// Catches answers before the commit, out of order, or of another closure.
TEST_F(WriteAsync, AnswersAfterTheCommitInOrder) {
  std::vector<int> answered;
  std::promise<void> last;
  for (int i = 0; i < 100; ++i) {
    store_->WriteAsync(
        [i](Transaction& transaction) -> absl::StatusOr<int> {
          const absl::Status stored =
              sql::Run(transaction.sql(), "INSERT INTO robots (id, message) VALUES ($1, x'')",
                       std::to_string(i));
          if (!stored.ok()) return stored;
          if (i % 10 == 3) return absl::InvalidArgumentError("no");
          return i;
        },
        [&, i](absl::StatusOr<int> result) {
          EXPECT_EQ(result.ok(), i % 10 != 3);
          EXPECT_EQ(result.value_or(i), i);
          answered.push_back(i);
          const auto seen = store_->Read([i](Snapshot& snapshot) {
            return sql::QueryInt64(snapshot.sql(), "SELECT COUNT(*) FROM robots WHERE id = $1",
                                   std::to_string(i));
          });
          EXPECT_EQ(*seen, i % 10 != 3) << "the answer came before the commit";
          if (i == 99) last.set_value();
        });
  }
  last.get_future().wait();
  ASSERT_EQ(answered.size(), 100u);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(answered[i], i);
}

// Catches a caller that waits for ever because the store closes before its turn.
TEST_F(WriteAsync, AClosingStoreAnswersAll) {
  absl::Notification inside, go;
  std::vector<absl::StatusCode> codes;
  store_->WriteAsync(
      [&](Transaction&) {
        inside.Notify();
        go.WaitForNotification();
        return absl::OkStatus();
      },
      [&](const absl::Status& status) { codes.push_back(status.code()); });
  inside.WaitForNotification();
  for (int i = 0; i < 3; ++i) {
    store_->WriteAsync([](Transaction&) { return absl::OkStatus(); },
                       [&](const absl::Status& status) { codes.push_back(status.code()); });
  }
  go.Notify();
  store_.reset();
  ASSERT_EQ(codes.size(), 4u);
  EXPECT_EQ(codes[0], absl::StatusCode::kOk) << "what runs is ended";
  for (int i = 1; i < 4; ++i) {
    EXPECT_TRUE(codes[i] == absl::StatusCode::kOk || codes[i] == absl::StatusCode::kCancelled);
  }
}

}  // namespace
}  // namespace truepose::store
