#include "server/jobs/worker_context.h"

#include "core/base/status_macros.h"
#include "server/jobs/job_state.h"
#include "server/store/jobs.h"

namespace truepose::jobs {

absl::Status WorkerContext::TellEnd(store::Transaction& transaction,
                                    const std::string& name) const {
  if (!options.on_end) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CalibrationJob job, store::GetJob(transaction, name));
  return IsTerminal(job.state()) ? options.on_end(transaction, job) : absl::OkStatus();
}

}  // namespace truepose::jobs
