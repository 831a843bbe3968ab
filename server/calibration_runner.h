// The runners of real jobs: convert::RunCalibration with its provenance, convert::RunTableBuild.
#pragma once

#include "server/jobs/runner.h"

namespace truepose::server {

jobs::Runner CalibrationRunner();

// All that trueposed does: the same, and tables with their estimates.
jobs::Runners RealRunners();

}  // namespace truepose::server
