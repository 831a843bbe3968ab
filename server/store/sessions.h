// Measurement sessions: OPEN -> SEALED. A sealed session never changes again.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "absl/status/statusor.h"
#include "google/protobuf/timestamp.pb.h"
#include "server/store/list.h"
#include "server/store/page.h"
#include "server/store/transaction.h"
#include "truepose/v1/session.pb.h"

namespace truepose::store {

// Stores an OPEN session for `session.robot`, with `session.nominal_revision` or, when empty, the
// robot's latest. Of `session` also source, extra_columns, created_by and what CopySessionSettings
// names are used. A repeat with the same values returns the session.
// @returns kInvalidArgument for the id or names; kNotFound for the robot or revision;
// kAlreadyExists for a session
//   with other values.
absl::StatusOr<v1::Session> CreateSession(Transaction& transaction, std::string_view session_id,
                                          const v1::Session& session);
// What people write about a session: display_name, purpose, instrument, fixture, operator,
// joint_source, placement, temperature_c, load_kg.
void CopySessionSettings(const v1::Session& from, v1::Session& session);
// Writes a new state of a session that is there. @returns it with its new revision and etag.
absl::StatusOr<v1::Session> PutSession(Transaction& transaction, v1::Session session);
// Also a deleted one.
absl::StatusOr<v1::Session> GetSession(Snapshot& snapshot, std::string_view name);
// Newest first; `robot` = "" lists those of all robots.
absl::StatusOr<Page<v1::Session>> ListSessions(Snapshot& snapshot, std::string_view robot,
                                               const PageRequest& request,
                                               const ListFilter<v1::Session>& filter = {});

// What a session keeps of the moment when it was sealed, beside count and digest.
struct Sealing {
  std::string principal;
  // Of the instrument, when it had expired by then.
  std::optional<google::protobuf::Timestamp> certificate_expired = {};
};

// Closes a session for readings. `digest` is of all its readings (convert::ReadingsDigest). A
// repeat with the same count and digest returns the session.
// @returns kFailedPrecondition with a fault when `reading_count` isn't what is stored, when it has
// no readings, or
//   when it is sealed with another digest.
absl::StatusOr<v1::Session> SealSession(Transaction& transaction, std::string_view name,
                                        int reading_count, std::string_view digest,
                                        const Sealing& sealing = {});

}  // namespace truepose::store
