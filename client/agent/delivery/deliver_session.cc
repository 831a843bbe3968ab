#include "client/agent/delivery/deliver_session.h"

#include "client/reading_upload.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

// At most 16 MB a message, of readings of 15 KB (intake/reading_check.h).
constexpr int kBatch = 1000;

// A session's file as what an upload reads.
class FileSpool : public client::ReadingSpool {
 public:
  FileSpool(SessionFile& session, const std::function<void()>& on_delivered)
      : session_(session), on_delivered_(on_delivered), last_(session.readings()) {}

  // As it stood at the begin, so that a source that goes on measuring keeps no upload from its end.
  int64_t last_sequence() const override { return last_; }
  absl::StatusOr<client::SpooledReadings> Read(int64_t sequence, int most) override {
    TRUEPOSE_ASSIGN_OR_RETURN(auto readings, session_.Read(sequence, most));
    return client::SpooledReadings{session_.content().name(), std::move(readings)};
  }
  void SetDurable(int64_t sequence) override {
    session_.delivered = sequence;
    if (on_delivered_) on_delivered_();
  }

 private:
  SessionFile& session_;
  const std::function<void()>& on_delivered_;
  const int64_t last_;
};

absl::Status Create(const client::Client& client, const v1::Session& content) {
  v1::CreateSessionRequest request;
  request.set_session_id(IdOf(content.name()));
  *request.mutable_session() = content;
  request.mutable_session()->clear_name();
  request.mutable_session()->clear_create_time();
  const absl::Status status = client.CreateSession(request).status();
  // Somebody has changed what UpdateSession may change; the id is nobody else's.
  return absl::IsAlreadyExists(status) ? absl::OkStatus() : status;
}

absl::Status Upload(const client::Client& client, SessionFile& session,
                    const std::function<void()>& on_delivered) {
  FileSpool spool(session, on_delivered);
  const client::ReadingUploadOptions options{
      .batch_size = kBatch, .batches_in_flight = 4, .patience = std::chrono::milliseconds(0)};
  return client::UploadSpool(client, IdOf(session.content().name()), spool, options).status();
}

}  // namespace

std::string IdOf(const std::string& session) { return session.substr(session.find('/') + 1); }

absl::StatusOr<bool> DeliverSession(const client::Client& client, SessionFile& session,
                                    const std::function<void()>& on_delivered) {
  // Asked first: what is sealed gets no more readings, so the upload then has all of them.
  const bool sealed = session.sealed();
  absl::Status status = Upload(client, session, on_delivered);
  if (absl::IsNotFound(status)) {
    TRUEPOSE_RETURN_IF_ERROR(Create(client, session.content()));
    status = Upload(client, session, on_delivered);
  }
  TRUEPOSE_RETURN_IF_ERROR(status);
  if (!sealed) return false;
  v1::SealSessionRequest seal;
  seal.set_name(session.content().name());
  seal.set_reading_count(static_cast<int>(session.readings()));
  TRUEPOSE_RETURN_IF_ERROR(client.SealSession(seal).status());
  return true;
}

}  // namespace truepose::agent
