// What the engine runs: given by the composition root, so that jobs don't depend on convert or
// core. A job calibrates, or it builds a compensation table.
#pragma once

#include <concepts>
#include <functional>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/compensation_table.pb.h"

namespace truepose::jobs {

struct RunnerHooks {
  // May be called from the running thread at any time; doesn't block.
  std::function<void(const v1::JobProgress&)> on_progress;
  // True asks the runner to end soon with kCancelled: cancelled, past its deadline, or the engine
  // stops.
  std::function<bool()> is_cancelled;
};

// Turns the frozen input into a result, without name, job and create_time. Runs on a worker thread,
// several at once.
using Runner =
    std::function<absl::StatusOr<v1::Calibration>(const v1::CalibrationInput&, const RunnerHooks&)>;

// The file of a table, and what stands in its head.
struct BuiltTable {
  std::string bytes;
  v1::CompensationTableHeader header;
};

// The same for a table. The same input gives the same bytes.
using TableBuilder = std::function<absl::StatusOr<BuiltTable>(const v1::CompensationTableInput&,
                                                              const RunnerHooks&)>;
// What a table would be, without building it; for calls that wait for it. Faults of the spec have
// the field paths of v1::CompensationTableSpec.
using TableEstimator =
    std::function<absl::StatusOr<v1::CompensationTableEstimate>(const v1::CompensationTableInput&)>;

// All that an engine can do. What is empty fails its jobs with kUnimplemented.
struct Runners {
  Runners() = default;
  // Of an engine that only calibrates.
  template <std::convertible_to<Runner> F>
  Runners(F run) : calibrate(std::move(run)) {}  // NOLINT(google-explicit-constructor)
  Runners(Runner run, TableBuilder build, TableEstimator estimate)
      : calibrate(std::move(run)),
        build_table(std::move(build)),
        estimate_table(std::move(estimate)) {}

  Runner calibrate;
  TableBuilder build_table;
  TableEstimator estimate_table;
};

}  // namespace truepose::jobs
