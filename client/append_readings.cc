#include "client/append_readings.h"

#include <algorithm>
#include <memory>
#include <thread>

#include "absl/strings/str_cat.h"
#include "client/window.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::client {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kPause{200};  // between connections

// One upload over as many connections as it takes.
class Upload {
 public:
  Upload(const Client& client, const std::string& session, const std::vector<v1::Reading>& readings,
         const AppendOptions& options)
      : client_(client), session_(session), readings_(readings), options_(options) {}

  absl::StatusOr<int> Run();

 private:
  int total() const { return static_cast<int>(readings_.size()); }
  int EndOfBatch(int row) const { return std::min(row + options_.batch_size, total()); }
  // Sends the rows from `row` over one stream and takes its acknowledgements.
  absl::Status SendFrom(int row);
  v1::AppendReadingsRequest Batch(int row) const;
  void Take(const v1::AppendReadingsResponse& acknowledgement);

  const Client& client_;
  const std::string& session_;
  const std::vector<v1::Reading>& readings_;
  const AppendOptions& options_;
  int acknowledged_ = 0;  // rows below are stored with our content
  int stored_ = 0;        // what the session holds by the last acknowledgement
  Clock::time_point last_answer_ = Clock::now();
};

absl::StatusOr<int> Upload::Run() {
  while (acknowledged_ < total()) {
    const absl::Status status = SendFrom(acknowledged_);
    if (status.ok()) continue;
    if (!absl::IsUnavailable(status) || Clock::now() - last_answer_ > options_.patience) {
      return status;
    }
    std::this_thread::sleep_for(kPause);
  }
  return stored_;
}

// Writes in a thread of its own: a transport without buffers takes no batch while its
// acknowledgements wait.
absl::Status Upload::SendFrom(int row) {
  const std::unique_ptr<AppendStream> stream = client_.OpenAppendStream();
  Window window(options_.batches_in_flight);
  std::thread writer([&, row]() mutable {
    bool alive = true;
    for (; alive && row < total() && window.Enter(); row = EndOfBatch(row))
      alive = stream->Write(Batch(row));
    stream->WritesDone();
  });
  v1::AppendReadingsResponse acknowledgement;
  while (stream->Read(&acknowledgement)) {
    Take(acknowledgement);
    window.Leave();
  }
  window.Close();
  writer.join();
  const absl::Status status = stream->Finish();
  if (!status.ok() || acknowledged_ == total()) return status;
  return absl::UnavailableError("the server ended the upload before its end");
}

v1::AppendReadingsRequest Upload::Batch(int row) const {
  v1::AppendReadingsRequest batch;
  batch.set_session(session_);
  const int end = EndOfBatch(row);
  for (; row < end; ++row) *batch.add_readings() = readings_[row];
  return batch;
}

void Upload::Take(const v1::AppendReadingsResponse& acknowledgement) {
  last_answer_ = Clock::now();
  stored_ = acknowledgement.reading_count();
  // Acknowledgements come in the order of the batches.
  acknowledged_ = EndOfBatch(acknowledged_);
  if (options_.on_progress) options_.on_progress(acknowledged_, total());
}

absl::StatusOr<int> CountOf(const Client& client, const std::string& session) {
  v1::GetSessionRequest request;
  request.set_name(session);
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session reply, client.GetSession(request));
  return reply.reading_count();
}

absl::Status Validate(const AppendOptions& options) {
  FaultList faults;
  if (options.batch_size < 1 || options.batch_size > 10000) {
    faults.Add("batch_size", absl::StrCat(options.batch_size), "1 to 10000");
  }
  if (options.batches_in_flight < 1) {
    faults.Add("batches_in_flight", absl::StrCat(options.batches_in_flight), "at least 1");
  }
  return faults.ToStatus();
}

}  // namespace

absl::StatusOr<int> AppendReadings(const Client& client, const std::string& session,
                                   const std::vector<v1::Reading>& readings,
                                   const AppendOptions& options) {
  TRUEPOSE_RETURN_IF_ERROR(Validate(options));
  if (readings.empty()) return CountOf(client, session);
  return Upload(client, session, readings, options).Run();
}

}  // namespace truepose::client
