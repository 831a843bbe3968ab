// Tokens and the tally, on every backend.
#include "server/store/tokens.h"

#include "absl/strings/str_cat.h"
#include "server/store/names.h"
#include "server/store/tally.h"
#include "tests/store/conformance/conformance.h"

namespace truepose::store {
namespace {

class TokensTest : public StoreConformance {
 protected:
  absl::StatusOr<v1::Token> Insert(int number, const std::string& principal,
                                   v1::PrincipalKind kind = v1::PERSON) {
    v1::Token token;
    token.set_principal(principal);
    token.set_kind(kind);
    return Write([&](Transaction& transaction) {
      return InsertToken(transaction, Uuid(number), absl::StrCat("hash", number), token);
    });
  }
  absl::StatusOr<v1::Token> Revoke(const std::string& name) {
    return Write([&](Transaction& transaction) { return RevokeToken(transaction, name); });
  }
  std::vector<StoredToken> All() {
    return *Read([](Snapshot& snapshot) { return AllTokens(snapshot); });
  }
};

// Would catch a token that comes back without what it was made with, or with a use nobody made.
TEST_P(TokensTest, IsReadAsItWasStored) {
  const auto token = Insert(1, "anna");
  ASSERT_TRUE(token.ok()) << token.status();
  EXPECT_EQ(token->name(), TokenName(Uuid(1)));
  EXPECT_EQ(token->create_time().seconds(), absl::ToUnixSeconds(clock_.Now()));
  ASSERT_EQ(All().size(), 1u);
  EXPECT_EQ(All()[0].token.SerializeAsString(), token->SerializeAsString());
  EXPECT_EQ(All()[0].secret_sha256, "hash1");
  EXPECT_EQ(All()[0].last_use, absl::InfinitePast());
}

// Would catch two tokens that one secret opens.
TEST_P(TokensTest, ASecondTokenOfOneSecretIsRefused) {
  ASSERT_TRUE(Insert(1, "anna").ok());
  const auto again = Write([](Transaction& transaction) {
    return InsertToken(transaction, Uuid(2), "hash1", v1::Token());
  });
  EXPECT_TRUE(absl::IsAlreadyExists(again.status())) << again.status();
}

// Would catch a second revocation that moves the time of the first.
TEST_P(TokensTest, RevokedOnceItStaysAsItIs) {
  ASSERT_TRUE(Insert(1, "anna").ok());
  const auto first = Revoke(TokenName(Uuid(1)));
  ASSERT_TRUE(first.ok()) << first.status();
  EXPECT_TRUE(first->has_revoke_time());
  clock_.Advance(absl::Hours(1));
  EXPECT_EQ(Revoke(TokenName(Uuid(1)))->SerializeAsString(), first->SerializeAsString());
  EXPECT_TRUE(absl::IsNotFound(Revoke(TokenName(Uuid(9))).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(Revoke("tokens/anna").status()));
}

TEST_P(TokensTest, TheLastUseIsKeptToTheMicrosecond) {
  ASSERT_TRUE(Insert(1, "anna").ok());
  const absl::Time time = absl::FromUnixMicros(1'700'000'000'000'001);
  ASSERT_TRUE(Write([&](Transaction& transaction) {
                return RecordTokenUse(transaction, TokenName(Uuid(1)), time);
              }).ok());
  EXPECT_EQ(All()[0].last_use, time);
}

// Would catch a page that begins with the last token of the one before, or forgets one.
TEST_P(TokensTest, AreListedNewestFirstInPages) {
  for (int i = 1; i <= 3; ++i) ASSERT_TRUE(Insert(i, "anna").ok());
  const auto page = [&](const std::string& token) {
    return *Read([&](Snapshot& snapshot) { return ListTokens(snapshot, {2, token}); });
  };
  const Page<v1::Token> first = page("");
  ASSERT_EQ(first.items.size(), 2u);
  EXPECT_EQ(first.items[0].name(), TokenName(Uuid(3)));
  const Page<v1::Token> second = page(first.next_page_token);
  ASSERT_EQ(second.items.size(), 1u);
  EXPECT_EQ(second.items[0].name(), TokenName(Uuid(1)));
  EXPECT_EQ(second.next_page_token, "");
}

TEST_P(TokensTest, APrincipalHasTheKindOfItsFirstToken) {
  ASSERT_TRUE(Insert(1, "cell-7", v1::MACHINE).ok());
  const auto kind = [&](const std::string& principal) {
    return *Read([&](Snapshot& snapshot) { return KindOfPrincipal(snapshot, principal); });
  };
  EXPECT_EQ(kind("cell-7"), v1::MACHINE);
  EXPECT_EQ(kind("cell"), v1::PRINCIPAL_KIND_UNSPECIFIED);
}

// Would catch a count that takes the number of sessions for that of their readings, or counts an
// empty session as one reading.
TEST_P(TokensTest, TheTallyCountsEverything) {
  AddRobotWithSession(*store_);  // ur10 and session 1
  AddSession(*store_, 2, "ur10", 7);
  AddSession(*store_, 3, "ur10", 0);
  AddJob(*store_, 1);
  const auto tally = Read([](Snapshot& snapshot) { return CountAll(snapshot); });
  ASSERT_TRUE(tally.ok()) << tally.status();
  EXPECT_EQ(tally->robots, 1);
  EXPECT_EQ(tally->sessions, 3);
  const int64_t of_first = tally->readings - 7;
  EXPECT_EQ(tally->pending_jobs, 1);
  EXPECT_EQ(tally->running_jobs, 0);
  EXPECT_EQ(tally->open_requests, 0);
  AddSession(*store_, 4, "ur10", 5);
  EXPECT_EQ(Read([](Snapshot& snapshot) { return CountAll(snapshot); })->readings, of_first + 12);
  EXPECT_GT(of_first, 0);
}

INSTANTIATE_TEST_SUITE_P(Backends, TokensTest,
                         ::testing::Values(Backend::kSqliteMemory, Backend::kSqliteFile));

}  // namespace
}  // namespace truepose::store
