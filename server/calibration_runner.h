// The runner of real jobs: convert::RunCalibration with its provenance.
#pragma once

#include "server/jobs/runner.h"

namespace truepose::server {

jobs::Runner CalibrationRunner();

}  // namespace truepose::server
