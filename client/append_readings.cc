#include "client/append_readings.h"

#include <algorithm>
#include <memory>
#include <thread>

#include "absl/strings/str_cat.h"
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
  absl::Status SendFrom(int row);
  // Sends the next batch; false: the stream is broken.
  bool Write(AppendStream& stream);
  // Waits for the next acknowledgement; false: there is none.
  bool Await(AppendStream& stream);

  const Client& client_;
  const std::string& session_;
  const std::vector<v1::Reading>& readings_;
  const AppendOptions& options_;
  int sent_ = 0;          // rows below were written to the present stream
  int in_flight_ = 0;     // batches written and not acknowledged
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

absl::Status Upload::SendFrom(int row) {
  sent_ = row;
  in_flight_ = 0;
  const std::unique_ptr<AppendStream> stream = client_.OpenAppendStream();
  bool alive = true;
  while (alive && sent_ < total()) {
    alive = in_flight_ < options_.batches_in_flight ? Write(*stream) : Await(*stream);
  }
  if (alive) stream->WritesDone();
  while (Await(*stream)) {
  }
  const absl::Status status = stream->Finish();
  if (!status.ok() || acknowledged_ == total()) return status;
  return absl::UnavailableError("the server ended the upload before its end");
}

bool Upload::Write(AppendStream& stream) {
  v1::AppendReadingsRequest batch;
  batch.set_session(session_);
  const int end = std::min(sent_ + options_.batch_size, total());
  for (int row = sent_; row < end; ++row) *batch.add_readings() = readings_[row];
  sent_ = end;
  ++in_flight_;
  return stream.Write(batch);
}

bool Upload::Await(AppendStream& stream) {
  v1::AppendReadingsResponse acknowledgement;
  if (!stream.Read(&acknowledgement)) return false;
  --in_flight_;
  last_answer_ = Clock::now();
  stored_ = acknowledgement.reading_count();
  // Acknowledgements come in the order of the batches, which are of batch_size rows but for the
  // last.
  acknowledged_ = std::min(acknowledged_ + options_.batch_size, total());
  if (options_.on_progress) options_.on_progress(acknowledged_, total());
  return true;
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
