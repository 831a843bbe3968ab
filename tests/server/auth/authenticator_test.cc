#include "server/auth/authenticator.h"

#include <set>

#include "absl/strings/str_cat.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "server/auth/secret.h"
#include "server/store/message.h"
#include "tests/server/testing/expect_status.h"
#include "tests/store/testing/fake_clock.h"
#include "tests/store/testing/samples.h"

namespace truepose::auth {
namespace {

using store::Uuid;
using ::testing::AllOf;
using testing::HasCode;
using ::testing::HasSubstr;
using testing::IsOk;
using ::testing::Not;

constexpr char kAnna[] = "secret of anna";
constexpr char kCell[] = "secret of cell-7";

class AuthenticatorTest : public ::testing::Test {
 protected:
  AuthenticatorTest() {
    store_ = *store::Store::Open({.path = ":memory:", .clock = &clock_});
    Add(1, "anna", v1::PERSON, kAnna, true);
    Add(2, "cell-7", v1::MACHINE, kCell, false);
    authenticator_ = *Authenticator::Load(*store_);
  }

  store::StoredToken Add(int number, const std::string& principal, v1::PrincipalKind kind,
                         const std::string& secret, bool admin,
                         absl::Duration holds = absl::InfiniteDuration()) {
    v1::Token token;
    token.set_principal(principal);
    token.set_kind(kind);
    token.set_admin(admin);
    if (holds < absl::InfiniteDuration())
      *token.mutable_expire_time() = store::ToTimestamp(clock_.Now() + holds);
    const auto stored = store_->Write([&](store::Transaction& transaction) {
      return store::InsertToken(transaction, Uuid(number), HashOf(secret), token);
    });
    EXPECT_THAT(stored, IsOk());
    return {.token = *stored, .secret_sha256 = HashOf(secret)};
  }
  store::StoredToken Revoke(int number) {
    const auto token = store_->Write([&](store::Transaction& transaction) {
      return store::RevokeToken(transaction, "tokens/" + Uuid(number));
    });
    EXPECT_THAT(token, IsOk());
    return {.token = *token, .secret_sha256 = ""};
  }
  absl::StatusOr<Caller> Show(const std::string& secret) {
    return authenticator_->Authenticate("Bearer " + secret);
  }
  absl::Time LastUse(size_t index) {
    // A write that waits behind the uses that were recorded without waiting.
    EXPECT_THAT(store_->Write([](store::Transaction&) { return absl::OkStatus(); }), IsOk());
    return (*store_->Read(
        [](store::Snapshot& snapshot) { return store::AllTokens(snapshot); }))[index]
        .last_use;
  }

  store::FakeClock clock_;
  std::unique_ptr<store::Store> store_;
  std::unique_ptr<Authenticator> authenticator_;
};

// Would catch a token that gives another principal, or a machine that counts as a person.
TEST_F(AuthenticatorTest, ATokenSaysWhoCalls) {
  const auto anna = Show(kAnna);
  ASSERT_THAT(anna, IsOk());
  EXPECT_EQ(anna->principal, "anna");
  EXPECT_FALSE(anna->is_machine);
  EXPECT_TRUE(anna->is_admin);
  EXPECT_FALSE(anna->is_local_dev);
  const auto cell = Show(kCell);
  ASSERT_THAT(cell, IsOk());
  EXPECT_EQ(cell->principal, "cell-7");
  EXPECT_TRUE(cell->is_machine);
  EXPECT_FALSE(cell->is_admin);
}

// Would catch a prefix or another form that is let in, and a refusal without the way on, or with
// the secret in it.
TEST_F(AuthenticatorTest, AnythingElseIsUnauthenticatedAndSaysWhatToDo) {
  for (const std::string& shown :
       {std::string(), std::string("Bearer "), std::string("Bearer"), std::string(kAnna),
        absl::StrCat("Basic ", kAnna), absl::StrCat("Bearer ", kAnna, "x"),
        absl::StrCat("Bearer  ", kAnna), absl::StrCat("Bearer ", HashOf(kAnna)),
        std::string("Bearer secret of ann")}) {
    const auto caller = authenticator_->Authenticate(shown);
    EXPECT_THAT(caller, HasCode(absl::StatusCode::kUnauthenticated)) << shown;
    EXPECT_THAT(std::string(caller.status().message()),
                AllOf(HasSubstr("truepose token create"), Not(HasSubstr("secret of ann"))));
  }
  EXPECT_THAT(authenticator_->Authenticate(absl::StrCat("bearer ", kAnna)), IsOk())
      << "RFC 7235: schemes are case-insensitive";
}

// Would catch a token that lives on after its revocation, in new calls or in streams.
TEST_F(AuthenticatorTest, ARevokedTokenEndsAtOnce) {
  const auto before = Show(kAnna);
  ASSERT_THAT(before, IsOk());
  EXPECT_THAT(authenticator_->Recheck(*before), IsOk());
  authenticator_->Learn(Revoke(1));
  EXPECT_THAT(Show(kAnna), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_THAT(authenticator_->Recheck(*before), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_THAT(Show(kCell), IsOk()) << "the other one holds";
  EXPECT_FALSE(authenticator_->HasAdmin());
}

// Would catch a creation that is told after the revocation and brings the token back.
TEST_F(AuthenticatorTest, TheOrderInWhichCommitsAreToldDoesNotMatter) {
  const store::StoredToken made = Add(3, "eve", v1::PERSON, "third", false);
  store::StoredToken revoked = Revoke(3);
  revoked.secret_sha256 = made.secret_sha256;
  authenticator_->Learn(revoked);
  authenticator_->Learn(made);
  EXPECT_THAT(Show("third"), HasCode(absl::StatusCode::kUnauthenticated));
}

// Would catch an expiry that is looked at when the server starts only, or off by one.
TEST_F(AuthenticatorTest, ATokenExpiresOnTime) {
  authenticator_->Learn(Add(3, "guest", v1::PERSON, "third", true, absl::Hours(1)));
  const auto guest = Show("third");
  ASSERT_THAT(guest, IsOk());
  clock_.Advance(absl::Hours(1) - absl::Microseconds(1));
  EXPECT_THAT(Show("third"), IsOk());
  clock_.Advance(absl::Microseconds(1));
  EXPECT_THAT(Show("third"), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_THAT(authenticator_->Recheck(*guest), HasCode(absl::StatusCode::kUnauthenticated));
}

// Would catch a server that forgets its tokens, or what was revoked, with its process.
TEST_F(AuthenticatorTest, AnotherStartKnowsTheSame) {
  Revoke(2);
  authenticator_ = *Authenticator::Load(*store_);
  EXPECT_THAT(Show(kAnna), IsOk());
  EXPECT_THAT(Show(kCell), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_TRUE(authenticator_->HasAdmin());
}

// Would catch a write with every call, and a use that is never recorded.
TEST_F(AuthenticatorTest, TheUseIsRecordedOnceAnHour) {
  EXPECT_EQ(LastUse(0), absl::InfinitePast());
  const absl::Time first = clock_.Now();
  ASSERT_THAT(Show(kAnna), IsOk());
  EXPECT_EQ(LastUse(0), first);
  EXPECT_EQ(LastUse(1), absl::InfinitePast());
  const int64_t revision = *store_->Revision();
  clock_.Advance(kUseResolution - absl::Seconds(1));
  for (int i = 0; i < 100; ++i) ASSERT_THAT(Show(kAnna), IsOk());
  EXPECT_EQ(LastUse(0), first);
  EXPECT_EQ(*store_->Revision(), revision + 1) << "LastUse writes once itself";
  clock_.Advance(absl::Seconds(1));
  ASSERT_THAT(Show(kAnna), IsOk());
  EXPECT_EQ(LastUse(0), first + kUseResolution);
}

TEST_F(AuthenticatorTest, OpenToAllEverybodyIsLocalDev) {
  const auto open = Authenticator::OpenToAll();
  for (const char* shown : {"", "Bearer whatever"}) {
    const auto caller = open->Authenticate(shown);
    ASSERT_THAT(caller, IsOk());
    EXPECT_EQ(caller->principal, "local-dev");
    EXPECT_TRUE(caller->is_local_dev);
    EXPECT_THAT(open->Recheck(*caller), IsOk());
  }
}

// Would catch a generator that repeats itself, and a secret with fewer bits than promised.
TEST(SecretTest, AreLongAndDiffer) {
  std::set<std::string> secrets;
  for (int i = 0; i < 1'000; ++i) secrets.insert(*NewSecret());
  EXPECT_EQ(secrets.size(), 1'000u);
  for (const std::string& secret : secrets) EXPECT_EQ(secret.size(), 9 + 64u);
}

}  // namespace
}  // namespace truepose::auth
