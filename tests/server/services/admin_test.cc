#include "server/services/admin.h"

#include <fstream>
#include <thread>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "server/auth/secret.h"
#include "server/services/administration.h"
#include "server/store/message.h"
#include "server/store/tokens.h"
#include "tests/server/testing/handler_test.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::services {
namespace {

using testing::FieldsOf;
using testing::HasCode;
using testing::HasFaultsAt;
using testing::HasFields;
using testing::IsOk;
using testing::Parse;

class AdminTest : public testing::HandlerTest {
 protected:
  AdminTest() {
    authenticator_ = *auth::Authenticator::Load(store());
    bootstrap_ = *auth::Bootstrap::Begin(folder_.File("t.db.bootstrap"), true);
    Build(*authenticator_);
  }

  void Build(auth::Authenticator& authenticator) {
    administration_.reset(new Administration{authenticator, *bootstrap_,
                                             ServerFacts{.version = "1.2.3",
                                                         .start = absl::FromUnixSeconds(1'000),
                                                         .time_zone = "Europe/Berlin",
                                                         .database_bytes = [] { return 4096; },
                                                         .watchers = [] { return 7; }}});
  }

  CallContext As(const Caller& caller) {
    return {store(), engine(), caller, administration_.get()};
  }
  CallContext AsAdmin() { return As({.principal = "anna", .is_local_dev = false}); }

  v1::BootstrapRequest FirstAdmin(const std::string& principal) {
    v1::BootstrapRequest request;
    std::ifstream(folder_.File("t.db.bootstrap")) >> *request.mutable_secret();
    request.set_principal(principal);
    return request;
  }
  absl::StatusOr<v1::CreateTokenResponse> Create(const std::string& token) {
    return CreateToken(AsAdmin(),
                       Parse<v1::CreateTokenRequest>(absl::StrCat("token {", token, "}")));
  }
  absl::StatusOr<auth::Caller> Show(const std::string& secret) {
    return authenticator_->Authenticate(absl::StrCat("Bearer ", secret));
  }

  testing::TempDir folder_;
  std::unique_ptr<auth::Authenticator> authenticator_;
  std::unique_ptr<auth::Bootstrap> bootstrap_;
  std::unique_ptr<Administration> administration_;
};

// Would catch a first admin who can't get in, or a second one by the same secret.
TEST_F(AdminTest, BootstrapMakesTheFirstAdminOnce) {
  const v1::BootstrapRequest request = FirstAdmin("anna");
  const auto made = Bootstrap(AsAdmin(), request);
  ASSERT_THAT(made, IsOk());
  EXPECT_THAT(made->token(),
              HasFields(R"(principal: "anna" kind: PERSON admin: true created_by: "bootstrap")"));
  EXPECT_FALSE(made->token().has_expire_time());
  EXPECT_TRUE(Show(made->secret())->is_admin);
  EXPECT_THAT(Bootstrap(AsAdmin(), request), HasCode(absl::StatusCode::kFailedPrecondition));
}

TEST_F(AdminTest, BootstrapWithAFaultyPrincipalUsesNothingUp) {
  EXPECT_THAT(Bootstrap(AsAdmin(), FirstAdmin("Anna B.")),
              HasFaultsAt(std::vector<std::string>{"principal"}));
  EXPECT_THAT(Bootstrap(AsAdmin(), FirstAdmin("server")),
              HasFaultsAt(std::vector<std::string>{"principal"}));
  EXPECT_THAT(Bootstrap(AsAdmin(), FirstAdmin("anna")), IsOk());
}

// Would catch a token of another principal or kind than asked for, and a caller who says who made
// it.
TEST_F(AdminTest, ATokenIsMadeAsAskedFor) {
  const auto made = Create(R"(principal: "cell-7" kind: MACHINE created_by: "eve"
                              name: "tokens/x" revoke_time { seconds: 1 })");
  ASSERT_THAT(made, IsOk());
  EXPECT_THAT(made->token(), HasFields(R"(principal: "cell-7" kind: MACHINE created_by: "anna")"));
  EXPECT_FALSE(made->token().has_revoke_time());
  const auto caller = Show(made->secret());
  ASSERT_THAT(caller, IsOk());
  EXPECT_EQ(caller->principal, "cell-7");
  EXPECT_TRUE(caller->is_machine);
}

// Would catch a store that can tell a secret: nothing of it may be in any column.
TEST_F(AdminTest, TheStoreHasTheHashOnly) {
  const auto made = Create(R"(principal: "ben" kind: PERSON)");
  ASSERT_THAT(made, IsOk());
  const auto all =
      store().Read([](store::Snapshot& snapshot) { return store::AllTokens(snapshot); });
  ASSERT_THAT(all, IsOk());
  ASSERT_EQ(all->size(), 1u);
  EXPECT_EQ(all->front().secret_sha256, auth::HashOf(made->secret()));
  EXPECT_FALSE(absl::StrContains(all->front().token.SerializeAsString(), made->secret()));
  EXPECT_FALSE(absl::StrContains(made->secret(), all->front().secret_sha256));
}

// Would catch a fault that hides behind another, an admin that is a machine, and a token that never
// held.
TEST_F(AdminTest, EveryFaultOfATokenIsNamed) {
  EXPECT_THAT(
      Create(R"(principal: "Ben" expire_time { seconds: 1 })"),
      HasFaultsAt(std::vector<std::string>{"token.principal", "token.kind", "token.expire_time"}));
  EXPECT_THAT(Create(R"(principal: "cell-7" kind: MACHINE admin: true)"),
              HasFaultsAt(std::vector<std::string>{"token.admin"}));
  const std::string longest(63, 'a');
  EXPECT_THAT(Create(absl::StrCat("kind: PERSON principal: '", longest, "'")), IsOk());
  for (const std::string& bad :
       {longest + "a", std::string(), std::string("-ben"), std::string("ben!"), std::string("b en"),
        std::string("local-dev"), std::string("server"), std::string("bootstrap")}) {
    EXPECT_THAT(Create(absl::StrCat("kind: PERSON principal: '", bad, "'")),
                HasFaultsAt(std::vector<std::string>{"token.principal"}))
        << bad;
  }
}

// Would catch the way around the second pair of eyes: a job of one's own machine token, approved
// with one's own person token.
TEST_F(AdminTest, APrincipalKeepsItsKind) {
  const auto first = Create(R"(principal: "ben" kind: PERSON)");
  ASSERT_THAT(first, IsOk());
  EXPECT_THAT(Create(R"(principal: "ben" kind: MACHINE)"),
              HasFaultsAt(std::vector<std::string>{"token.kind"}));
  v1::RevokeTokenRequest revoke;
  revoke.set_name(first->token().name());
  ASSERT_THAT(RevokeToken(AsAdmin(), revoke), IsOk());
  EXPECT_THAT(Create(R"(principal: "ben" kind: MACHINE)"),
              HasFaultsAt(std::vector<std::string>{"token.kind"}))
      << "also after the first is revoked";
  EXPECT_THAT(Create(R"(principal: "ben" kind: PERSON admin: true)"), IsOk());
}

// Would catch a revocation that waits for the next start, or that is not repeatable.
TEST_F(AdminTest, ARevokedTokenIsOutAtOnce) {
  const auto made = Create(R"(principal: "ben" kind: PERSON)");
  ASSERT_THAT(made, IsOk());
  v1::RevokeTokenRequest request;
  request.set_name(made->token().name());
  const auto revoked = RevokeToken(AsAdmin(), request);
  ASSERT_THAT(revoked, IsOk());
  EXPECT_TRUE(revoked->has_revoke_time());
  EXPECT_THAT(Show(made->secret()), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_EQ(RevokeToken(AsAdmin(), request)->SerializeAsString(), revoked->SerializeAsString());
  request.set_name(absl::StrCat("tokens/", testing::kUnknown));
  EXPECT_THAT(RevokeToken(AsAdmin(), request), HasCode(absl::StatusCode::kNotFound));
  request.set_name("tokens/ben");
  EXPECT_THAT(RevokeToken(AsAdmin(), request), HasCode(absl::StatusCode::kInvalidArgument));
}

class RepeatedToken : public AdminTest {
 protected:
  absl::StatusOr<v1::CreateTokenResponse> Ask(const std::string& principal = "cell-7") {
    auto request = Parse<v1::CreateTokenRequest>(R"pb(token { kind: MACHINE })pb");
    request.mutable_token()->set_principal(principal);
    request.set_request_id(testing::kSession1);
    return CreateToken(AsAdmin(), request);
  }
  void WaitForUse(const std::string& token) {
    // Writes come one after the other: one that was asked for later has passed it.
    ASSERT_THAT(store().Write([](store::Transaction&) { return absl::OkStatus(); }), IsOk());
    const auto all = *ListTokens(AsAdmin(), {});
    ASSERT_EQ(all.tokens(0).name(), token);
    ASSERT_TRUE(all.tokens(0).has_last_use_time());
  }
};

// Would catch a retry that leaves a second token behind which nobody knows, or one that tells no
// secret; and a secret that is stored to be told again.
TEST_F(RepeatedToken, IsTheSameOneWithASecretThatWorks) {
  const auto first = Ask();
  ASSERT_THAT(first, IsOk());
  const auto again = Ask();
  ASSERT_THAT(again, IsOk());
  EXPECT_EQ(again->token().SerializeAsString(), first->token().SerializeAsString());
  EXPECT_EQ(ListTokens(AsAdmin(), {})->tokens_size(), 1);
  EXPECT_NE(again->secret(), first->secret());
  EXPECT_THAT(Show(first->secret()), HasCode(absl::StatusCode::kUnauthenticated));
  EXPECT_THAT(Show(again->secret()), IsOk());
  const auto restarted = *auth::Authenticator::Load(store());
  EXPECT_THAT(restarted->Authenticate("Bearer " + again->secret()), IsOk());
  EXPECT_THAT(restarted->Authenticate("Bearer " + first->secret()),
              HasCode(absl::StatusCode::kUnauthenticated));
}

// Would catch a repeat that takes a machine's secret away while it works with it.
TEST_F(RepeatedToken, WhatIsUsedStays) {
  const auto first = Ask();
  ASSERT_THAT(first, IsOk());
  ASSERT_THAT(Show(first->secret()), IsOk());
  WaitForUse(first->token().name());
  EXPECT_THAT(Ask(), HasCode(absl::StatusCode::kAlreadyExists));
  EXPECT_EQ(FieldsOf(Ask().status()), std::vector<std::string>{"request_id"});
  EXPECT_THAT(Show(first->secret()), IsOk());
}

// Would catch a repeat that brings back what was revoked, and an id that is taken for another
// request.
TEST_F(RepeatedToken, WhatIsRevokedStaysSo) {
  const auto first = Ask();
  ASSERT_THAT(first, IsOk());
  EXPECT_THAT(Ask("cell-8"), HasFaultsAt(std::vector<std::string>{"request_id"}));
  v1::RevokeTokenRequest revoke;
  revoke.set_name(first->token().name());
  ASSERT_THAT(RevokeToken(AsAdmin(), revoke), IsOk());
  EXPECT_THAT(Ask(), HasCode(absl::StatusCode::kAlreadyExists));
  EXPECT_THAT(Show(first->secret()), HasCode(absl::StatusCode::kUnauthenticated));
}

// Would catch two repeats at once after which neither's secret is the one that the store has.
TEST_F(RepeatedToken, OfManyAtOnceOneSecretWorks) {
  std::vector<std::string> secrets(8);
  std::vector<std::thread> clients;
  for (std::string& secret : secrets) clients.emplace_back([&] { secret = Ask()->secret(); });
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(ListTokens(AsAdmin(), {})->tokens_size(), 1);
  const auto restarted = *auth::Authenticator::Load(store());
  int works = 0;
  for (const std::string& secret : secrets) {
    const bool stored = restarted->Authenticate("Bearer " + secret).ok();
    EXPECT_EQ(Show(secret).ok(), stored);
    works += stored ? 1 : 0;
  }
  EXPECT_EQ(works, 1);
}

// Would catch a server to which nobody can ever be added again.
TEST_F(AdminTest, TheLastAdminStays) {
  const auto first = Create(R"(principal: "ben" kind: PERSON admin: true)");
  ASSERT_THAT(first, IsOk());
  v1::RevokeTokenRequest request;
  request.set_name(first->token().name());
  EXPECT_THAT(RevokeToken(AsAdmin(), request), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(Show(first->secret()), IsOk());
  ASSERT_THAT(Create(R"(principal: "eva" kind: PERSON admin: true)"), IsOk());
  EXPECT_THAT(RevokeToken(AsAdmin(), request), IsOk());
  EXPECT_THAT(RevokeToken(AsAdmin(), request), IsOk()) << "a repeat";
}

// Would catch a use that is recorded and never told.
TEST_F(AdminTest, TheListTellsOfTheLastUse) {
  const auto made = Create(R"(principal: "ben" kind: PERSON)");
  ASSERT_THAT(made, IsOk());
  EXPECT_FALSE(ListTokens(AsAdmin(), {})->tokens(0).has_last_use_time());
  ASSERT_THAT(store().Write([&](store::Transaction& transaction) {
    return store::RecordTokenUse(transaction, made->token().name(), absl::FromUnixSeconds(7'000));
  }),
              IsOk());
  EXPECT_EQ(ListTokens(AsAdmin(), {})->tokens(0).last_use_time().seconds(), 7'000);
}

TEST_F(AdminTest, TokensAreListedInPages) {
  for (const char* principal : {"a", "b", "c"})
    ASSERT_THAT(Create(absl::StrCat("kind: PERSON principal: '", principal, "'")), IsOk());
  v1::ListTokensRequest request;
  request.set_page_size(2);
  const auto first = ListTokens(AsAdmin(), request);
  ASSERT_THAT(first, IsOk());
  ASSERT_EQ(first->tokens_size(), 2);
  EXPECT_EQ(first->tokens(0).principal(), "c");
  request.set_page_token(first->next_page_token());
  EXPECT_EQ(ListTokens(AsAdmin(), request)->tokens(0).principal(), "a");
  request.set_page_token("x");
  EXPECT_THAT(ListTokens(AsAdmin(), request), HasFaultsAt(std::vector<std::string>{"page_token"}));
}

// Would catch a server that is open to everybody and lets everybody make an admin for later.
TEST_F(AdminTest, AServerThatAsksForNoTokensMakesNone) {
  const auto open = auth::Authenticator::OpenToAll();
  const v1::BootstrapRequest request = FirstAdmin("anna");
  Build(*open);
  EXPECT_THAT(Bootstrap(As({}), request), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_THAT(Create(R"(principal: "ben" kind: PERSON)"),
              HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_TRUE(GetServerStatus(As({}), {})->dev_open());
}

TEST_F(AdminTest, TheStatusSaysHowTheServerIsAndWhoAsks) {
  AddRobot("ur10");
  AddSession(testing::kSession1, "ur10", 5);
  const auto status = GetServerStatus(
      As({.principal = "cell-7", .is_machine = true, .is_admin = false, .is_local_dev = false}),
      {});
  ASSERT_THAT(status, IsOk());
  EXPECT_THAT(*status, HasFields(R"(version: "1.2.3" time_zone: "Europe/Berlin"
      start_time { seconds: 1000 } principal: "cell-7" principal_kind: MACHINE robots: 1 sessions: 1
      readings: 5 database_bytes: 4096 watchers: 7)"));
  EXPECT_FALSE(status->dev_open());
  EXPECT_EQ(status->epoch(), store().epoch());
  EXPECT_EQ(status->revision(), *store().Revision());
}

}  // namespace
}  // namespace truepose::services
