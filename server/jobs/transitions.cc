#include "server/jobs/transitions.h"

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/jobs/job_state.h"
#include "server/store/calibrations.h"
#include "server/store/message.h"

namespace truepose::jobs {
namespace {

using store::Snapshot;
using store::Transaction;

constexpr store::Lease kNobody = 0;

absl::Status ChangeState(Transaction& transaction, v1::CalibrationJob& job, v1::JobState to,
                         store::Lease lease) {
  TRUEPOSE_RETURN_IF_ERROR(CheckTransition(job.state(), to));
  job.set_state(to);
  if (IsTerminal(to)) *job.mutable_end_time() = store::ToTimestamp(transaction.now());
  return store::UpdateJob(transaction, job, lease);
}

absl::Status Fail(Transaction& transaction, v1::CalibrationJob& job, const absl::Status& error) {
  *job.mutable_error() = ToJobError(error);
  return ChangeState(transaction, job, v1::FAILED, kNobody);
}

// Stores what the job was for. @returns the calibration that it is about.
absl::StatusOr<std::string> StoreResult(Transaction& transaction, const v1::CalibrationJob& job,
                                        const Outcome& outcome) {
  if (outcome.table.has_value()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTable table,
                              store::FinishTable(transaction, job, *outcome.table));
    return table.calibration();
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration calibration,
                            store::InsertCalibration(transaction, job, outcome.calibration));
  return calibration.name();
}

absl::Status Succeed(Transaction& transaction, v1::CalibrationJob& job, const Outcome& outcome) {
  TRUEPOSE_ASSIGN_OR_RETURN(*job.mutable_calibration(), StoreResult(transaction, job, outcome));
  return ChangeState(transaction, job, v1::SUCCEEDED, kNobody);
}

absl::Status PutBack(Transaction& transaction, v1::CalibrationJob& job) {
  job.clear_start_time();
  return ChangeState(transaction, job, v1::PENDING, kNobody);
}

bool IsLate(const Transaction& transaction, const v1::CalibrationJob& job) {
  return store::DeadlineOf(job) <= transaction.now();
}

absl::Status FailAsLate(Transaction& transaction, v1::CalibrationJob& job) {
  const bool began = job.state() == v1::RUNNING;
  return Fail(transaction, job,
              absl::DeadlineExceededError(absl::StrCat(
                  "its deadline ", absl::FormatTime(store::DeadlineOf(job), absl::UTCTimeZone()),
                  " passed before it ", began ? "ended" : "began")));
}

absl::Status Apply(Transaction& transaction, v1::CalibrationJob& job, const Outcome& outcome) {
  if (job.cancel_requested()) return ChangeState(transaction, job, v1::CANCELLED, kNobody);
  switch (outcome.kind) {
    case Outcome::Kind::kResult:
      if (IsLate(transaction, job)) return FailAsLate(transaction, job);
      return Succeed(transaction, job, outcome);
    case Outcome::Kind::kCancelled:
      return ChangeState(transaction, job, v1::CANCELLED, kNobody);
    case Outcome::Kind::kStopped:
      job.set_attempts(job.attempts() - 1);
      return PutBack(transaction, job);
    case Outcome::Kind::kError:
      break;
  }
  return Fail(transaction, job, outcome.error);
}

absl::Status EndLease(Transaction& transaction, v1::CalibrationJob& job, int max_attempts,
                      std::string_view reason) {
  if (job.cancel_requested()) return ChangeState(transaction, job, v1::CANCELLED, kNobody);
  if (IsLate(transaction, job)) return FailAsLate(transaction, job);
  if (job.attempts() < max_attempts) return PutBack(transaction, job);
  return Fail(
      transaction, job,
      absl::AbortedError(absl::StrCat("begun ", job.attempts(), " times, and the last time ",
                                      std::string(reason), "; create a new job to try again")));
}

// The claimed job, if the lease is still the claim's.
absl::StatusOr<std::optional<v1::CalibrationJob>> HeldJob(Snapshot& snapshot, const Claim& claim) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, store::GetJob(snapshot, claim.job.name()));
  TRUEPOSE_ASSIGN_OR_RETURN(const store::Lease lease, store::GetLease(snapshot, claim.job.name()));
  if (job.state() != v1::RUNNING || lease != claim.lease) return std::nullopt;
  return std::optional(std::move(job));
}

}  // namespace

v1::JobError ToJobError(const absl::Status& error) {
  v1::JobError told;
  told.set_code(error.raw_code());
  told.set_message(std::string(error.message()));
  for (const Fault& fault : FaultsOf(error)) {
    v1::Fault& one = *told.add_faults();
    one.set_field(fault.field);
    one.set_found(fault.found);
    one.set_expected(fault.expected);
  }
  return told;
}

absl::StatusOr<std::optional<Claim>> ClaimNext(Transaction& transaction) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::optional<std::string> name,
                            store::NextJob(transaction, transaction.now()));
  if (!name.has_value()) return std::optional<Claim>();
  Claim claim;
  TRUEPOSE_ASSIGN_OR_RETURN(claim.job, store::GetJob(transaction, *name));
  claim.lease = transaction.revision();
  claim.job.set_attempts(claim.job.attempts() + 1);
  *claim.job.mutable_start_time() = store::ToTimestamp(transaction.now());
  TRUEPOSE_RETURN_IF_ERROR(ChangeState(transaction, claim.job, v1::RUNNING, claim.lease));
  return std::optional<Claim>(std::move(claim));
}

absl::StatusOr<bool> EndJob(Transaction& transaction, const Claim& claim, const Outcome& outcome) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto job, HeldJob(transaction, claim));
  if (!job.has_value()) return false;
  TRUEPOSE_RETURN_IF_ERROR(Apply(transaction, *job, outcome));
  return true;
}

absl::StatusOr<bool> TakeBack(Transaction& transaction, const Claim& claim, int max_attempts,
                              std::string_view reason) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto job, HeldJob(transaction, claim));
  if (!job.has_value()) return false;
  TRUEPOSE_RETURN_IF_ERROR(EndLease(transaction, *job, max_attempts, reason));
  return true;
}

absl::StatusOr<std::vector<std::string>> FailLate(Transaction& transaction) {
  // So many that one commit isn't long; the next look takes the rest.
  constexpr int kAtOnce = 100;
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<std::string> names,
                            store::LatePendingJobs(transaction, transaction.now(), kAtOnce));
  for (const std::string& name : names) {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, store::GetJob(transaction, name));
    TRUEPOSE_RETURN_IF_ERROR(FailAsLate(transaction, job));
  }
  return names;
}

absl::StatusOr<v1::CalibrationJob> RequestCancel(Transaction& transaction, std::string_view name) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, store::GetJob(transaction, name));
  if (job.state() == v1::CANCELLED || (job.state() == v1::RUNNING && job.cancel_requested()))
    return job;
  if (IsTerminal(job.state())) {
    return store::Refusal(absl::StatusCode::kFailedPrecondition, "name",
                          absl::StrCat(job.name(), ", which is ", v1::JobState_Name(job.state())),
                          "a job that is PENDING or RUNNING");
  }
  job.set_cancel_requested(true);
  if (job.state() == v1::PENDING) {
    TRUEPOSE_RETURN_IF_ERROR(ChangeState(transaction, job, v1::CANCELLED, kNobody));
    return job;
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const store::Lease lease, store::GetLease(transaction, name));
  TRUEPOSE_RETURN_IF_ERROR(store::UpdateJob(transaction, job, lease));
  return job;
}

absl::StatusOr<std::vector<std::string>> RecoverRunning(Transaction& transaction,
                                                        int max_attempts) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<std::string> names,
                            store::JobsInState(transaction, v1::RUNNING));
  for (const std::string& name : names) {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CalibrationJob job, store::GetJob(transaction, name));
    TRUEPOSE_RETURN_IF_ERROR(
        EndLease(transaction, job, max_attempts, "the server ended before the job did"));
  }
  return names;
}

}  // namespace truepose::jobs
