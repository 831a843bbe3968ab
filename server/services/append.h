// AppendReadings, the only RPC whose path has to be short: what one stream knows, and the two steps
// of a message. Everything that can be done beside the one thread that writes is done in the first.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <variant>

#include "absl/status/statusor.h"
#include "server/services/call_context.h"
#include "server/store/reading_sources.h"
#include "truepose/v1/services.pb.h"

namespace truepose::services {

inline constexpr int kMostReadingsOfBatch = 10'000;

// One AppendReadings stream. Its first message says how readings are addressed: with a source by
// (source, sequence), where each message may name another session; without by their rows, in the
// one session of the first message. Its calls come one at a time.
class AppendStream {
 public:
  using Done = std::function<void(absl::StatusOr<v1::AppendReadingsResponse>)>;

  explicit AppendStream(const CallContext& call) : call_(call) {}

  // Whether the message is small and of a session that the stream knows, so that Append neither
  // reads the store nor computes for long.
  bool IsQuick(const v1::AppendReadingsRequest& request) const;

  // Checks a message and stores its readings, all or none. `done` gets the acknowledgement after
  // the commit; at once when there is nothing to store.
  // @returns (to `done`) kInvalidArgument with every fault of the message; kNotFound for a session;
  //   kAborted for readings that are stored with another content; kOutOfRange for a gap;
  //   kFailedPrecondition for new readings of a sealed or deleted session.
  void Append(const v1::AppendReadingsRequest& request, Done done);

 private:
  // A batch of a session whose readings say their rows.
  struct RowBatch {
    std::string session;
    store::ReadingBatch readings;
  };
  using Batch = std::variant<RowBatch, store::SourceBatch>;

  absl::StatusOr<v1::AppendReadingsResponse> Ask(const v1::AppendReadingsRequest& request) const;
  absl::Status Begin(const v1::AppendReadingsRequest& request);
  absl::Status CheckAddress(const v1::AppendReadingsRequest& request) const;
  absl::Status CheckReadings(const v1::AppendReadingsRequest& request, int joints) const;
  absl::StatusOr<int> JointsOf(const std::string& session);
  const std::string& SessionOf(const v1::AppendReadingsRequest& request) const;
  absl::StatusOr<Batch> Prepare(const v1::AppendReadingsRequest& request);

  const CallContext call_;
  bool begun_ = false;
  std::string source_;   // "" = by row
  std::string session_;  // of the last message that named one
  // Of the sessions of this stream, how many joints their robots have. A session's nominal revision
  // never changes.
  std::map<std::string, int> joints_;
};

}  // namespace truepose::services
