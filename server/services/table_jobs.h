// Compensation tables in the store: which calibration may have one, queueing the job that builds
// it, and which one is to be applied on a robot. Each within a transaction of the caller, so that
// an activation and its table are one commit.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/transaction.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/compensation_table.pb.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::services {

// A table that somebody wants.
struct NewTable {
  std::string robot;  // robots/{robot}
  std::string id;     // a UUID; "" = the server makes one
  v1::Calibration calibration;
  v1::CompensationTableSpec spec;
  std::string created_by;
  bool created_by_machine = false;
  int priority = 0;
};

// @returns kFailedPrecondition with a fault of `compensation_table.calibration` for one that is
// rejected, whose verdict is do_not_apply, or that is a draft unless `allow_draft`.
absl::Status CheckMayHaveTable(const v1::Calibration& calibration, bool allow_draft);

// Everything that building the table needs, as its job will load it.
// @returns kInvalidArgument with every fault of the spec, below `compensation_table.spec`.
absl::StatusOr<v1::CompensationTableInput> InputOf(store::Snapshot& snapshot,
                                                   const NewTable& wanted);

// Stores the table BUILDING and its job, which has the same UUID; wake the engine after the commit.
// A repeat of the id, and a table of equal input that is READY or BUILDING, gives what there is.
// @returns InputOf's faults; kAlreadyExists for an id with another content.
absl::StatusOr<v1::CompensationTable> QueueTable(store::Transaction& transaction,
                                                 const NewTable& wanted);

// Queues the table of the robot's active calibration by its table_spec; nothing without either.
// What can't be built is stored as a FAILED table with the reason: an activation never fails for
// it.
absl::Status QueueActiveTable(store::Transaction& transaction, const v1::Robot& robot,
                              const std::string& principal, bool is_machine);

// The table to apply (Robot.active_compensation_table); "" = none.
absl::StatusOr<std::string> TableToApply(store::Snapshot& snapshot, const v1::Robot& robot);

// Writes the robot if another table is to be applied by now.
absl::Status RefreshTableToApply(store::Transaction& transaction, const std::string& robot);

// After the end of a job, in its commit: a table whose job FAILED or was CANCELLED is FAILED with
// the reason, one that is READY may be the robot's to apply. Nothing for other jobs.
absl::Status EndTableJob(store::Transaction& transaction, const v1::CalibrationJob& job);

}  // namespace truepose::services
