#include "server/calibration_runner.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "absl/time/clock.h"
#include "convert/run.h"
#include "convert/table_build.h"
#include "server/rpc/guard.h"
#include "server/rpc/log.h"

namespace truepose::server {
namespace {

// Outside of the result's digest: it says where and how fast, not what.
void SetProvenance(absl::Duration elapsed, v1::Calibration& calibration) {
  v1::Provenance& provenance = *calibration.mutable_provenance();
  provenance.set_version(TRUEPOSE_VERSION);
  provenance.set_dispatch("baseline");
  provenance.set_threads(1);
  provenance.set_seconds(absl::ToDoubleSeconds(elapsed));
}

absl::StatusOr<v1::Calibration> Run(const v1::CalibrationInput& input,
                                    const jobs::RunnerHooks& hooks) {
  const absl::Time start = absl::Now();
  absl::StatusOr<v1::Calibration> calibration = rpc::Guarded([&] {
    return convert::RunCalibration(
        input, {.on_progress = hooks.on_progress, .is_cancelled = hooks.is_cancelled});
  });
  const absl::Duration elapsed = absl::Now() - start;
  if (calibration.ok()) SetProvenance(elapsed, *calibration);
  rpc::LogInfo(absl::StrCat("calibration of ", input.robot(), ": ",
                            absl::StatusCodeToString(calibration.status().code()), " after ",
                            absl::FormatDuration(absl::Trunc(elapsed, absl::Milliseconds(1)))));
  return calibration;
}

absl::StatusOr<jobs::BuiltTable> BuildTable(const v1::CompensationTableInput& input,
                                            const jobs::RunnerHooks& hooks) {
  const absl::Time start = absl::Now();
  absl::StatusOr<convert::TableFile> file = rpc::Guarded([&] {
    return convert::RunTableBuild(
        input, {.on_progress = hooks.on_progress, .is_cancelled = hooks.is_cancelled});
  });
  const absl::Duration elapsed = absl::Now() - start;
  rpc::LogInfo(absl::StrCat("table of ", input.calibration().name(), ": ",
                            absl::StatusCodeToString(file.status().code()), " after ",
                            absl::FormatDuration(absl::Trunc(elapsed, absl::Milliseconds(1)))));
  if (!file.ok()) return file.status();
  return jobs::BuiltTable{std::move(file->bytes), std::move(file->header)};
}

}  // namespace

jobs::Runner CalibrationRunner() { return Run; }

jobs::Runners RealRunners() { return {Run, BuildTable, convert::RunTableEstimate}; }

}  // namespace truepose::server
