#include "server/services/append.h"

#include <optional>
#include <utility>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;
using Response = v1::AppendReadingsResponse;

// What takes less time than a change of threads is worth.
constexpr int kMostQuickReadings = 256;
// Streams that name more sessions ask for them again.
constexpr size_t kMostSessions = 1'000;

Response Acknowledge(int reading_count, int64_t durable_sequence) {
  Response response;
  response.set_reading_count(reading_count);
  response.set_durable_sequence(durable_sequence);
  return response;
}

absl::StatusOr<Response> Store(Transaction& transaction, const store::SourceBatch& batch) {
  TRUEPOSE_ASSIGN_OR_RETURN(const store::SourceProgress progress,
                            store::AppendFromSource(transaction, batch));
  return Acknowledge(progress.reading_count, progress.durable_sequence);
}

}  // namespace

bool AppendStream::IsQuick(const v1::AppendReadingsRequest& request) const {
  return begun_ && request.readings_size() > 0 && request.readings_size() <= kMostQuickReadings &&
         joints_.count(SessionOf(request)) > 0;
}

void AppendStream::Append(const v1::AppendReadingsRequest& request, Done done) {
  if (!begun_) {
    const absl::Status begun = Begin(request);
    if (!begun.ok()) return done(begun);
  }
  absl::StatusOr<Batch> batch = Prepare(request);
  if (!batch.ok()) return done(batch.status());
  if (request.readings().empty()) return done(Ask(request));
  call_.store.WriteAsync(
      [batch = std::make_shared<const Batch>(*std::move(batch))](Transaction& transaction) {
        if (const auto* from_source = std::get_if<store::SourceBatch>(batch.get())) {
          return Store(transaction, *from_source);
        }
        const RowBatch& rows = std::get<RowBatch>(*batch);
        const absl::StatusOr<int> count =
            store::AppendReadings(transaction, rows.session, rows.readings);
        return count.ok() ? absl::StatusOr<Response>(Acknowledge(*count, 0)) : count.status();
      },
      std::move(done));
}

absl::Status AppendStream::Begin(const v1::AppendReadingsRequest& request) {
  if (!request.source().empty()) {
    TRUEPOSE_RETURN_IF_ERROR(store::CheckUuid(request.source(), "source"));
  } else {
    TRUEPOSE_RETURN_IF_ERROR(JointsOf(request.session()).status());
  }
  source_ = request.source();
  begun_ = true;
  return absl::OkStatus();
}

// What is stored, for a message without readings.
absl::StatusOr<Response> AppendStream::Ask(const v1::AppendReadingsRequest& request) const {
  const std::string& session = SessionOf(request);
  return call_.store.Read([&](Snapshot& snapshot) -> absl::StatusOr<Response> {
    int count = 0;
    if (!session.empty()) {
      TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session found, store::GetSession(snapshot, session));
      count = found.reading_count();
    }
    TRUEPOSE_ASSIGN_OR_RETURN(const int64_t durable, store::DurableSequence(snapshot, source_));
    return Acknowledge(count, durable);
  });
}

const std::string& AppendStream::SessionOf(const v1::AppendReadingsRequest& request) const {
  return request.session().empty() ? session_ : request.session();
}

absl::Status AppendStream::CheckAddress(const v1::AppendReadingsRequest& request) const {
  FaultList faults;
  if (!request.source().empty() && request.source() != source_) {
    faults.Add("source", request.source(),
               source_.empty() ? "none, as in the first message"
                               : absl::StrCat(source_, " as in the first message"));
  }
  if (source_.empty() && !session_.empty() && SessionOf(request) != session_) {
    faults.Add("session", request.session(), absl::StrCat(session_, " as in the first message"));
  }
  const int count = request.readings_size();
  if (count > kMostReadingsOfBatch) {
    faults.Add("readings", absl::StrCat(count),
               absl::StrCat("at most ", kMostReadingsOfBatch, " a message"));
  } else if (count > 0 && source_.empty() && request.readings(0).row() < 0) {
    faults.Add("readings[0].row", absl::StrCat(request.readings(0).row()),
               "rows that count from 0");
  } else if (count > 0 && !source_.empty() && request.first_sequence() < 1) {
    faults.Add("first_sequence", absl::StrCat(request.first_sequence()), "1 or more");
  }
  return faults.ToStatus();
}

absl::Status AppendStream::CheckReadings(const v1::AppendReadingsRequest& request,
                                         int joints) const {
  if (request.readings().empty()) return absl::OkStatus();
  // The server gives the rows of a source's readings, whatever these say.
  if (!source_.empty()) return convert::ValidateReadings(joints, request.readings(), std::nullopt);
  return convert::ValidateReadings(joints, request.readings(), request.readings(0).row());
}

absl::StatusOr<int> AppendStream::JointsOf(const std::string& session) {
  const auto known = joints_.find(session);
  if (known != joints_.end()) return known->second;
  TRUEPOSE_RETURN_IF_ERROR(store::ParseSessionName(session, "session").status());
  const auto nominal = call_.store.Read([&](Snapshot& snapshot) {
    const absl::StatusOr<v1::Session> found = store::GetSession(snapshot, session);
    if (!found.ok()) return absl::StatusOr<v1::NominalRevision>(found.status());
    return store::GetNominalRevision(snapshot, found->nominal_revision());
  });
  if (absl::IsNotFound(nominal.status())) return store::UnknownSession(session);
  TRUEPOSE_RETURN_IF_ERROR(nominal.status());
  if (joints_.size() >= kMostSessions) joints_.clear();
  return joints_[session] = nominal->nominal().joints_size();
}

absl::StatusOr<AppendStream::Batch> AppendStream::Prepare(
    const v1::AppendReadingsRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckAddress(request));
  const std::string session = SessionOf(request);
  // Only a source's question where to go on needs no session.
  if (source_.empty() || !session.empty() || !request.readings().empty()) {
    TRUEPOSE_ASSIGN_OR_RETURN(const int joints, JointsOf(session));
    TRUEPOSE_RETURN_IF_ERROR(CheckReadings(request, joints));
    session_ = session;
  }
  store::ReadingBatch readings(request.readings());
  if (source_.empty()) return Batch(RowBatch{session, std::move(readings)});
  return Batch(store::SourceBatch{source_, request.first_sequence(), session, std::move(readings)});
}

}  // namespace truepose::services
