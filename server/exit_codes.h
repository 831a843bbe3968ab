// What trueposed tells the shell (docs/operations.md). client/exit_codes.h has the same numbers,
// and a test holds them equal.
#pragma once

namespace truepose::server {

enum ExitCode : int {
  kExitOk = 0,
  kExitRunFailed = 1,    // the run or job failed or was cancelled
  kExitUsage = 2,        // the command line was not understood
  kExitInput = 3,        // a file or a value has faults; each is named
  kExitUnavailable = 4,  // the server is unreachable, or the address to serve at is taken
  kExitDatabase = 5,     // the database can't be opened or used
  kExitNotFound = 6,     // no resource has that name
  kExitNotAllowed = 7,   // no token, one that holds no longer, or one that may not
};

}  // namespace truepose::server
