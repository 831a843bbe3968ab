// Handlers of SessionService (proto/truepose/v1/services.proto). Each checks its request, then runs
// one store closure.
// @returns kInvalidArgument with every fault of the request and its field path; kNotFound for a
// name that is well
//   formed and unknown; what the store says else. Nothing is stored on failure.
#pragma once

#include <string>

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

inline constexpr int kMostReadingsOfBatch = 10'000;

absl::StatusOr<v1::Session> CreateSession(const CallContext& call,
                                          const v1::CreateSessionRequest& request);
absl::StatusOr<v1::Session> GetSession(const CallContext& call,
                                       const v1::GetSessionRequest& request);
absl::StatusOr<v1::ListSessionsResponse> ListSessions(const CallContext& call,
                                                      const v1::ListSessionsRequest& request);
absl::StatusOr<v1::Session> SealSession(const CallContext& call,
                                        const v1::SealSessionRequest& request);
absl::StatusOr<v1::ListReadingsResponse> ListReadings(const CallContext& call,
                                                      const v1::ListReadingsRequest& request);

// What one AppendReadings stream knows from its first message on. A session's nominal revision
// never changes, so it is read once a stream.
struct AppendState {
  std::string session;
  v1::Nominal nominal;
};

// One batch of a stream, stored whole or not at all.
// @returns the acknowledgement, after the commit; kAborted for a row that is stored with another
// content.
absl::StatusOr<v1::AppendReadingsResponse> AppendReadings(const CallContext& call,
                                                          AppendState& state,
                                                          const v1::AppendReadingsRequest& request);

}  // namespace truepose::services
