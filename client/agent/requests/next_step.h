// What comes next for a robot's open request; decided anew from what is so, each time.
//
//   PENDING       its poses are fetched, it is acknowledged
//   ACKNOWLEDGED  once a session with readings for it is on the server: that is reported
//   MEASURING     how many readings there are, and another session, is reported;
//                 once the session is sealed on the server: calibrate
//   CALIBRATING   nothing: the server ends it, or sets it back to MEASURING when the job failed;
//                 then another session is waited for
// A person who declined it comes first in each state.
#pragma once

#include <cstdint>
#include <string>

#include "client/agent/requests/request_file.h"

namespace truepose::agent {

enum class StepKind { kNone, kFetchPoses, kAcknowledge, kReport, kCalibrate, kDecline };

// How far the session that was begun for the request is.
struct RequestSession {
  int64_t delivered = 0;  // readings that the server has
  bool settled = false;   // sealed on the server
};

struct NextStepOptions {
  bool acknowledge = true;  // false: a person takes requests on
};

StepKind NextStep(const OpenRequest& open, const RequestSession& session,
                  const NextStepOptions& options);

}  // namespace truepose::agent
