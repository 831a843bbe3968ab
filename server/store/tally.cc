#include "server/store/tally.h"

#include "absl/status/status.h"
#include "core/base/status_macros.h"
#include "server/store/open_request.h"
#include "server/store/resources.h"
#include "server/store/sql/query.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::store {
namespace {

constexpr char kReadings[] =
    "SELECT COALESCE(SUM(readings), 0) FROM (SELECT (SELECT MAX(row_index) + 1 FROM readings "
    "WHERE session = sequence) AS readings FROM sessions) AS counted";

absl::StatusOr<int64_t> CountJobs(Snapshot& snapshot, v1::JobState state) {
  return sql::QueryInt64(snapshot.sql(), "SELECT COUNT(*) FROM jobs WHERE state = $1",
                         static_cast<int>(state));
}

absl::StatusOr<int64_t> CountOpenRequests(Snapshot& snapshot) {
  int64_t open = 0;
  // None is taken into a page, so that one look passes all.
  const auto count = [&open](const std::string& bytes) -> absl::StatusOr<bool> {
    v1::RecalibrationRequest request;
    if (!request.ParseFromString(bytes)) return absl::DataLossError("a stored request");
    open += IsOpen(request.state()) ? 1 : 0;
    return false;
  };
  ResourceList requests;
  requests.kind = v1::KIND_RECALIBRATION_REQUEST;
  requests.only_open = true;
  TRUEPOSE_RETURN_IF_ERROR(ListResources(snapshot, requests, {}, count).status());
  return open;
}

}  // namespace

absl::StatusOr<Tally> CountAll(Snapshot& snapshot) {
  Tally tally;
  sql::Connection& sql = snapshot.sql();
  TRUEPOSE_ASSIGN_OR_RETURN(tally.robots,
                            sql::QueryInt64(sql, "SELECT COUNT(*) FROM robots WHERE deleted = 0"));
  TRUEPOSE_ASSIGN_OR_RETURN(
      tally.sessions, sql::QueryInt64(sql, "SELECT COUNT(*) FROM sessions WHERE deleted = 0"));
  TRUEPOSE_ASSIGN_OR_RETURN(tally.readings, sql::QueryInt64(sql, kReadings));
  TRUEPOSE_ASSIGN_OR_RETURN(tally.pending_jobs, CountJobs(snapshot, v1::PENDING));
  TRUEPOSE_ASSIGN_OR_RETURN(tally.running_jobs, CountJobs(snapshot, v1::RUNNING));
  TRUEPOSE_ASSIGN_OR_RETURN(tally.open_requests, CountOpenRequests(snapshot));
  return tally;
}

}  // namespace truepose::store
