#include "client/reading_upload.h"

#include <algorithm>
#include <memory>
#include <thread>
#include <utility>

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
  Upload(const Client& client, const std::string& source, ReadingSpool& spool,
         const ReadingUploadOptions& options)
      : client_(client),
        source_(source),
        spool_(spool),
        options_(options),
        target_(spool.last_sequence()) {}

  absl::StatusOr<int64_t> Run();

 private:
  absl::Status SendOverOneStream();
  // Asks where to go on.
  absl::Status Begin(AppendStream& stream);
  // Writes everything behind `durable`. @returns what the spool answers.
  absl::Status WriteAll(AppendStream& stream, Window& window, int64_t durable);
  bool Read(AppendStream& stream);
  absl::Status SpoolIsShort() const;

  const Client& client_;
  const std::string& source_;
  ReadingSpool& spool_;
  const ReadingUploadOptions& options_;
  const int64_t target_;
  int64_t durable_ = 0;
  Clock::time_point last_answer_ = Clock::now();
};

absl::StatusOr<int64_t> Upload::Run() {
  for (;;) {
    const absl::Status status = SendOverOneStream();
    if (status.ok()) return durable_;
    if (!absl::IsUnavailable(status) || Clock::now() - last_answer_ > options_.patience) {
      return status;
    }
    std::this_thread::sleep_for(kPause);
  }
}

absl::Status Upload::SendOverOneStream() {
  const std::unique_ptr<AppendStream> stream = client_.OpenAppendStream();
  TRUEPOSE_RETURN_IF_ERROR(Begin(*stream));
  if (durable_ > target_) {
    return SpoolIsShort();
  }
  Window window(options_.batches_in_flight);
  absl::Status spooled;
  std::thread writer([&, durable = durable_] { spooled = WriteAll(*stream, window, durable); });
  while (Read(*stream)) window.Leave();
  window.Close();
  writer.join();
  const absl::Status status = stream->Finish();
  TRUEPOSE_RETURN_IF_ERROR(spooled);
  if (!status.ok() || durable_ >= target_) return status;
  return absl::UnavailableError("the server ended the upload before its end");
}

absl::Status Upload::Begin(AppendStream& stream) {
  v1::AppendReadingsRequest question;
  question.set_source(source_);
  if (stream.Write(question) && Read(stream)) return absl::OkStatus();
  const absl::Status status = stream.Finish();
  return status.ok() ? absl::UnavailableError("the server ended the upload at once") : status;
}

absl::Status Upload::WriteAll(AppendStream& stream, Window& window, int64_t durable) {
  absl::Status status;
  for (int64_t next = durable + 1; next <= target_ && window.Enter();) {
    const int most = static_cast<int>(std::min<int64_t>(options_.batch_size, target_ - next + 1));
    absl::StatusOr<SpooledReadings> spooled = spool_.Read(next, most);
    status = spooled.status();
    if (!status.ok()) break;
    v1::AppendReadingsRequest batch;
    batch.set_source(source_);
    batch.set_session(std::move(spooled->session));
    batch.set_first_sequence(next);
    next += static_cast<int64_t>(spooled->readings.size());
    for (v1::Reading& reading : spooled->readings) *batch.add_readings() = std::move(reading);
    if (!stream.Write(batch)) break;
  }
  stream.WritesDone();
  return status;
}

bool Upload::Read(AppendStream& stream) {
  v1::AppendReadingsResponse acknowledgement;
  if (!stream.Read(&acknowledgement)) return false;
  last_answer_ = Clock::now();
  durable_ = acknowledgement.durable_sequence();
  spool_.SetDurable(durable_);
  return true;
}

absl::Status Upload::SpoolIsShort() const {
  FaultList faults;
  faults.Add(
      "source", absl::StrCat(source_, ", of which the server holds ", durable_, " readings"),
      absl::StrCat("at most the ", target_, " of the spool; a new spool needs a new source"));
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

}  // namespace

absl::Status ReadingUploadOptions::Validate() const {
  FaultList faults;
  if (batch_size < 1 || batch_size > 10000) {
    faults.Add("batch_size", absl::StrCat(batch_size), "1 to 10000");
  }
  if (batches_in_flight < 1) {
    faults.Add("batches_in_flight", absl::StrCat(batches_in_flight), "at least 1");
  }
  return faults.ToStatus();
}

absl::StatusOr<int64_t> UploadSpool(const Client& client, const std::string& source,
                                    ReadingSpool& spool, const ReadingUploadOptions& options) {
  TRUEPOSE_RETURN_IF_ERROR(options.Validate());
  return Upload(client, source, spool, options).Run();
}

}  // namespace truepose::client
