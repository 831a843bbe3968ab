// Runs jobs on worker threads: calibrations, and compensation tables.
//
// A worker claims the PENDING job whose turn it is (the highest priority, then the order of
// creation, one RUNNING job a robot) in one commit: RUNNING, attempts + 1, a lease. It loads the
// frozen input, runs it and writes the end in one commit: calibration or table + SUCCEEDED, or
// FAILED, or CANCELLED. Only the holder of the lease may end a job, so nothing runs to SUCCEEDED
// twice.
//
// A lease is renewed by every call of the runner's hooks. A worker that calls none for `lease`
// loses it: the job is put back, another thread takes the worker's place, and what the silent one
// brings in the end changes nothing. Leases are void at a restart: Start() puts every RUNNING job
// back to PENDING. Instead of back, a job goes to its end when its cancellation was asked for, its
// deadline has passed, or it was begun too often. A job whose deadline passes is FAILED, whether it
// waits, runs or ran in another process. Progress lives in memory only. All functions are safe from
// any thread.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/jobs/runner.h"
#include "server/jobs/watch.h"
#include "server/store/store.h"
#include "truepose/v1/watch.pb.h"

namespace truepose::jobs {

struct EngineOptions {
  int workers = 1;                              // jobs that run at once; 1 to 64
  absl::Duration deadline = absl::Minutes(10);  // a run that takes longer is FAILED
  int max_attempts = 3;                         // a job begun so often without an end is FAILED
  // Silence after which a worker loses its job; above the longest time between two calls of the
  // runner's hooks and the loading of the longest input.
  absl::Duration lease = absl::Minutes(2);
  absl::Duration sweep = absl::Milliseconds(500);  // between looks for deadlines and lost leases
  absl::Duration store_retry =
      absl::Seconds(1);  // pause before a refused write (full disk) is tried again

  // Called in the transaction that makes a calibrating job SUCCEEDED, with its calibration: what
  // has to happen with the result in the same commit. An error fails the job. May be empty; may run
  // more than once, as every closure.
  std::function<absl::Status(store::Transaction&, const v1::Calibration&)> with_result;

  // Called in the transaction that ends a job, whoever ends it: SUCCEEDED (after with_result),
  // FAILED or CANCELLED. What waits for the job moves on in the same commit. An error undoes the
  // end, which is tried again. May be empty; may run more than once, as every closure.
  std::function<absl::Status(store::Transaction&, const v1::CalibrationJob&)> on_end;

  // Told what no caller hears of, such as a result that can't be stored yet; from any thread. May
  // be empty.
  std::function<void(const std::string&)> on_warning;

  // For tests, which end the process there: called at each place of failpoints.h that is passed,
  // from any thread. May be empty.
  std::function<void(std::string_view)> at_point;

  // Every fault at once, with the option's name as field.
  absl::Status Validate() const;
};

class JobEngine {
 public:
  // Store and clock outlive the engine. Nothing runs before Start().
  JobEngine(store::Store& store, Runners runners, EngineOptions options,
            const store::Clock& clock = store::RealClock());
  // Stop().
  ~JobEngine();

  // Takes up what an earlier process left behind, then starts the workers. Once only.
  // @returns kInvalidArgument for options; the store's error, and then nothing runs.
  absl::Status Start();
  // Ends workers, then watches. Running jobs are asked to end and go back to PENDING, the attempt
  // not counted. Call it after the listeners are closed. May be called again.
  void Stop();

  // Call after the commit that created a job.
  void Wake();

  // The job with its progress. @returns kInvalidArgument for the name, kNotFound.
  absl::StatusOr<v1::CalibrationJob> Get(const std::string& name);
  // PENDING becomes CANCELLED at once. RUNNING keeps running until it notices, with
  // cancel_requested set, and never becomes SUCCEEDED after that. CANCELLED is returned as it is.
  // @returns kNotFound; kFailedPrecondition for SUCCEEDED and FAILED.
  // `within`, when given, is called in the transaction with the cancellation as its effect, and
  // answers for it: where a request id is looked up.
  using Effect = std::function<absl::StatusOr<v1::CalibrationJob>()>;
  using Within =
      std::function<absl::StatusOr<v1::CalibrationJob>(store::Transaction&, const Effect&)>;
  absl::StatusOr<v1::CalibrationJob> Cancel(const std::string& name, const Within& within = {});
  // Of the jobs that run now and have told any; `robot` = "" for all robots. In memory only.
  std::vector<v1::WatchedProgress> Progress(std::string_view robot) const;
  // What a table would be (Runners::estimate_table), in the calling thread. @returns kUnimplemented
  // without one.
  absl::StatusOr<v1::CompensationTableEstimate> EstimateTable(
      const v1::CompensationTableInput& input) const;
  // @returns kNotFound; kUnavailable after Stop().
  absl::StatusOr<std::unique_ptr<Subscription>> Watch(const std::string& name,
                                                      WatchCallbacks callbacks);

 private:
  class State;
  std::unique_ptr<State> state_;
};

}  // namespace truepose::jobs
