#include "tests/integration/authenticated_fixture.h"

#include <fstream>

#include "absl/strings/str_cat.h"
#include "client/channel.h"
#include "server/calibration_runner.h"
#include "tests/server/testing/expect_status.h"

namespace truepose::testing {

AuthenticatedFixture::AuthenticatedFixture() {
  options_.listen = absl::StrCat("unix:", folder_.File("s.sock"));
  options_.database = folder_.File("t.db");
  Restart();
  v1::BootstrapRequest request;
  std::ifstream(server_->bootstrap_file()) >> *request.mutable_secret();
  request.set_principal("admin");
  const auto made = WithSecret("").Bootstrap(request);
  EXPECT_THAT(made, IsOk());
  Keep(*made);
  Create("anna", v1::PERSON);
  Create("ben", v1::PERSON);
  Create("cell", v1::MACHINE);
}

void AuthenticatedFixture::Restart() {
  server_.reset();
  auto server = server::Server::Start(options_, server::CalibrationRunner());
  ASSERT_THAT(server, IsOk());
  server_ = *std::move(server);
}

void AuthenticatedFixture::Create(const std::string& principal, v1::PrincipalKind kind) {
  v1::CreateTokenRequest request;
  request.mutable_token()->set_principal(principal);
  request.mutable_token()->set_kind(kind);
  const auto made = As("admin").CreateToken(request);
  ASSERT_THAT(made, IsOk());
  Keep(*made);
}

void AuthenticatedFixture::Keep(const v1::CreateTokenResponse& made) {
  secrets_[made.token().principal()] = made.secret();
  tokens_[made.token().principal()] = made.token().name();
}

client::Client AuthenticatedFixture::As(const std::string& principal) const {
  return WithSecret(principal.empty() ? "" : Secret(principal));
}

client::Client AuthenticatedFixture::WithSecret(const std::string& secret) const {
  auto client = client::Client::Connect(options_.listen, {.token = secret});
  EXPECT_THAT(client, IsOk());
  return *std::move(client);
}

std::shared_ptr<grpc::Channel> AuthenticatedFixture::Channel() const {
  return client::MakeChannel(options_.listen);
}

void AuthenticatedFixture::Show(const std::string& principal, grpc::ClientContext& context) const {
  context.AddMetadata("authorization", absl::StrCat("Bearer ", Secret(principal)));
}

void AuthenticatedFixture::Revoke(const std::string& principal) const {
  v1::RevokeTokenRequest request;
  request.set_name(tokens_.at(principal));
  ASSERT_THAT(As("admin").RevokeToken(request), IsOk());
}

}  // namespace truepose::testing
