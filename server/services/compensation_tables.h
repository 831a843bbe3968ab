// Handlers of CompensationTableService (proto/truepose/v1/compensation_table_services.proto); get
// and list are the standard ones (standard.h).
// @returns kInvalidArgument with every fault of the request and its field path; kNotFound; what
// table_jobs.h says else. Nothing is stored on failure.
#pragma once

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/compensation_table_services.pb.h"

namespace truepose::services {

// Queues the job and wakes a worker. With validate_only the answer is the table without a state,
// with its estimate (jobs::TableEstimator).
absl::StatusOr<v1::CompensationTable> CreateCompensationTable(
    const CallContext& call, const v1::CreateCompensationTableRequest& request);
// @returns kNotFound with a fault of `robot` that says why there is none.
absl::StatusOr<v1::CompensationTable> GetActiveCompensationTable(
    const CallContext& call, const v1::GetActiveCompensationTableRequest& request);
// @returns kFailedPrecondition for one that is BUILDING. A robot whose table to apply this is gets
// another one, or none, in the same commit.
absl::StatusOr<v1::CompensationTable> DeleteCompensationTable(
    const CallContext& call, const v1::DeleteCompensationTableRequest& request);
absl::StatusOr<v1::CompensationTable> UndeleteCompensationTable(
    const CallContext& call, const v1::UndeleteCompensationTableRequest& request);

}  // namespace truepose::services
