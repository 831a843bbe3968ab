// Robots and their nominal revisions. Revisions are immutable and numbered from 1; a robot shows
// its latest.
#pragma once

#include <string_view>

#include "absl/status/statusor.h"
#include "server/store/list.h"
#include "server/store/page.h"
#include "server/store/transaction.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::store {

// `digest` identifies the content of `nominal` (convert::NominalDigest). Of `settings` are taken
// what CopyRobotSettings names. A repeat with the digest of the first or the latest revision
// returns the robot as it is.
// @returns kInvalidArgument for the id, kAlreadyExists for a robot with other content, or
// a deleted one.
absl::StatusOr<v1::Robot> CreateRobot(Transaction& transaction, std::string_view robot_id,
                                      const v1::Nominal& nominal, std::string_view digest,
                                      const v1::Robot& settings = {});
// What a person may change: display_name, release_policy, limits, table_spec.
void CopyRobotSettings(const v1::Robot& from, v1::Robot& robot);
// Writes a new state of a robot that is there (its nominals stay) and records the event. @returns
// the robot with its new revision and etag.
absl::StatusOr<v1::Robot> PutRobot(Transaction& transaction, const v1::Robot& robot);
// Adds a revision; the digest of the latest returns that one.
// @returns kNotFound for an unknown robot.
absl::StatusOr<v1::NominalRevision> AddNominalRevision(Transaction& transaction,
                                                       std::string_view robot_name,
                                                       const v1::Nominal& nominal,
                                                       std::string_view digest);

// Also a deleted one. @returns kInvalidArgument for a malformed name, kNotFound.
absl::StatusOr<v1::Robot> GetRobot(Snapshot& snapshot, std::string_view name);
absl::StatusOr<v1::NominalRevision> GetNominalRevision(Snapshot& snapshot, std::string_view name);

// Robots by id; revisions newest first.
absl::StatusOr<Page<v1::Robot>> ListRobots(Snapshot& snapshot, const PageRequest& request,
                                           const ListFilter<v1::Robot>& filter = {});
absl::StatusOr<Page<v1::NominalRevision>> ListNominalRevisions(Snapshot& snapshot,
                                                               std::string_view robot_name,
                                                               const PageRequest& request);

}  // namespace truepose::store
