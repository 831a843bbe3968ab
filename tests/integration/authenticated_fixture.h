// A server within the process that asks for tokens, and the people and machines around it.
#pragma once

#include <map>
#include <memory>
#include <string>

#include "client/client.h"
#include "grpcpp/client_context.h"
#include "gtest/gtest.h"
#include "server/server.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::testing {

class AuthenticatedFixture : public ::testing::Test {
 protected:
  // Starts a server and makes `admin`, by the bootstrap file, `anna` and `ben`, persons, and
  // `cell`, a machine.
  AuthenticatedFixture();

  // Stops the server and starts another on the same address and database.
  void Restart();
  const std::string& Secret(const std::string& principal) const { return secrets_.at(principal); }
  // "" = without a token.
  client::Client As(const std::string& principal) const;
  client::Client WithSecret(const std::string& secret) const;
  std::shared_ptr<grpc::Channel> Channel() const;
  // For calls by stubs.
  void Show(const std::string& principal, grpc::ClientContext& context) const;
  void Revoke(const std::string& principal) const;

  TempDir folder_;
  server::ServerOptions options_;

 private:
  void Keep(const v1::CreateTokenResponse& made);
  void Create(const std::string& principal, v1::PrincipalKind kind);

  std::unique_ptr<server::Server> server_;
  std::map<std::string, std::string> secrets_;  // by principal
  std::map<std::string, std::string> tokens_;   // their names, by principal
};

}  // namespace truepose::testing
