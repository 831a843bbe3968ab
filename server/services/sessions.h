// Handlers of SessionService (proto/truepose/v1/services.proto) but for AppendReadings, which is in
// append.h. Each checks its request, then runs
// one store closure.
// @returns kInvalidArgument with every fault of the request and its field path; kNotFound for a
// name that is well
//   formed and unknown; what the store says else. Nothing is stored on failure.
#pragma once

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

absl::StatusOr<v1::Session> CreateSession(const CallContext& call,
                                          const v1::CreateSessionRequest& request);
absl::StatusOr<v1::Session> UpdateSession(const CallContext& call,
                                          const v1::UpdateSessionRequest& request);
absl::StatusOr<v1::Session> DeleteSession(const CallContext& call,
                                          const v1::DeleteSessionRequest& request);
absl::StatusOr<v1::Session> UndeleteSession(const CallContext& call,
                                            const v1::UndeleteSessionRequest& request);
absl::StatusOr<v1::Session> GetSession(const CallContext& call,
                                       const v1::GetSessionRequest& request);
absl::StatusOr<v1::ListSessionsResponse> ListSessions(const CallContext& call,
                                                      const v1::ListSessionsRequest& request);
absl::StatusOr<v1::Session> SealSession(const CallContext& call,
                                        const v1::SealSessionRequest& request);
absl::StatusOr<v1::ListReadingsResponse> ListReadings(const CallContext& call,
                                                      const v1::ListReadingsRequest& request);

}  // namespace truepose::services
