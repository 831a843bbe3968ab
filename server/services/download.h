// What of a resource is too big for one message: its bytes in chunks, from any offset
// (proto/truepose/v1/download_services.proto).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "truepose/v1/download_services.pb.h"

namespace truepose::services {

inline constexpr size_t kChunkBytes = 256 << 10;

// One download; its calls come one at a time. Of a session it holds a page of readings and a chunk,
// however long the session is; a calibration is held whole; of a table's file a piece and a
// chunk.
class Download {
 public:
  // Reads the resource once for its size and digest.
  // @returns kInvalidArgument with every fault of the request; kNotFound; kFailedPrecondition for a
  //   session that isn't sealed and a table that isn't READY; kOutOfRange for an offset beyond the
  //   end; kAborted when the bytes are no longer those of the request's digest.
  static absl::StatusOr<std::unique_ptr<Download>> Begin(const CallContext& call,
                                                         const v1::DownloadRequest& request);

  // The next chunk; nothing after the last.
  absl::StatusOr<std::optional<v1::DownloadResponse>> Next();

 private:
  // Each call gives the piece that follows; "" at the end.
  using Pieces = std::function<absl::StatusOr<std::string>()>;

  Download() = default;
  static absl::StatusOr<Pieces> PiecesOf(const CallContext& call, const std::string& name);
  static absl::StatusOr<Pieces> PiecesOfSession(const CallContext& call, const std::string& name);
  static absl::StatusOr<Pieces> PiecesOfTable(const CallContext& call, const std::string& name);
  absl::Status Measure(const Pieces& pieces);
  absl::Status CheckResumed(const v1::DownloadRequest& request) const;
  absl::Status Skip(int64_t offset);
  absl::Status Fill();

  Pieces pieces_;
  std::string waiting_;  // read and not sent
  int64_t offset_ = 0;   // of its first byte
  int64_t total_ = 0;
  std::string sha256_;
  bool has_sent_ = false;
};

}  // namespace truepose::services
