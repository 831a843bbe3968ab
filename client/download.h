// What is too big for one message, whole and checked, however often the connection breaks.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "absl/status/statusor.h"
#include "client/client.h"

namespace truepose::client {

struct DownloadOptions {
  // How long the server may stay away before the download is given up. Counted anew from each
  // chunk; who never answered is told at once.
  std::chrono::milliseconds patience{30'000};
  // The digest that the bytes must have, "" = any: of a table, CompensationTable.sha256.
  std::string sha256 = {};
  // After each chunk: how many bytes of all are here.
  std::function<void(int64_t have, int64_t total)> on_progress = {};
};

// The bytes of a resource: of a Calibration for robots/{robot}/calibrations/{number}, of a
// SessionInput for sessions/{session}, the file for robots/{robot}/compensationTables/{id}. After a
// broken connection it goes on with the byte that comes next; when the resource was changed
// meanwhile it begins again.
// @returns kNotFound; kFailedPrecondition for a session that isn't sealed or a table that isn't
//   READY; kUnavailable when the server stays away; kAborted when the server's bytes have another
//   digest than options.sha256; kDataLoss when the bytes are not those that the server announced.
absl::StatusOr<std::string> Download(const Client& client, const std::string& name,
                                     const DownloadOptions& options = {});

}  // namespace truepose::client
