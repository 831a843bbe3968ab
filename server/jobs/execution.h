// One run of a claimed job, from its frozen input to its outcome. Writes nothing.
#pragma once

#include "server/jobs/transitions.h"
#include "server/jobs/worker_context.h"

namespace truepose::jobs {

// Loads and runs. Every call of the runner's hooks renews the lease. The run is asked to end when
// it is cancelled or has lost its lease, when the engine stops, or when its time is over: the
// engine's limit, or the job's deadline, which is turned into monotonic time at the begin so that
// nobody ends a run by setting the clock.
Outcome Execute(const WorkerContext& context, RunningJob& running);

}  // namespace truepose::jobs
