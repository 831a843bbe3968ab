// Tokens and the server's status. Who may call which is decided before
// (server/auth/access_table.h).
#pragma once

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/admin_services.pb.h"

namespace truepose::services {

// The first admin, a person whose token never expires. The secret is used up with it.
// @returns kInvalidArgument for the principal; kPermissionDenied for another secret;
// kFailedPrecondition when no bootstrap is due, or the server asks for no tokens.
absl::StatusOr<v1::CreateTokenResponse> Bootstrap(const CallContext& call,
                                                  const v1::BootstrapRequest& request);

// Of `token` counts what a caller decides: principal, kind, admin, expire_time.
// A principal has one kind for ever: a machine that became a person could approve what it made. An
// admin is a person, since an admin makes tokens of persons.
// A repeat of a request with an id makes no second token: as no secret is stored, it gets the first
// one's with a new secret, and the secret of the first answer ends. One at a time.
// @returns kInvalidArgument with every fault; kFailedPrecondition when the server asks for no
// tokens; kAlreadyExists for a repeat when the token was used or revoked, which never breaks a
// secret that somebody has.
absl::StatusOr<v1::CreateTokenResponse> CreateToken(const CallContext& call,
                                                    const v1::CreateTokenRequest& request);
// Newest first.
absl::StatusOr<v1::ListTokensResponse> ListTokens(const CallContext& call,
                                                  const v1::ListTokensRequest& request);
// Also the caller's own, but not the last of an admin, after which nobody could make another:
// kFailedPrecondition. Calls and streams of the token end with kUnauthenticated from then on. A
// repeat returns the same.
absl::StatusOr<v1::Token> RevokeToken(const CallContext& call,
                                      const v1::RevokeTokenRequest& request);

absl::StatusOr<v1::ServerStatus> GetServerStatus(const CallContext& call,
                                                 const v1::GetServerStatusRequest& request);

}  // namespace truepose::services
