#include "server/services/download.h"

#include <algorithm>
#include <utility>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/calibrations.h"
#include "server/store/checksum.h"
#include "server/store/compensation_tables.h"
#include "server/store/files.h"
#include "server/store/message.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/sessions.h"
#include "truepose/v1/calibration.pb.h"

namespace truepose::services {
namespace {

using store::Snapshot;

bool IsTable(const std::string& name) { return absl::StrContains(name, "/compensationTables/"); }

absl::Status CheckRequest(const v1::DownloadRequest& request) {
  FaultList faults;
  if (IsTable(request.name())) {
    faults.AddAll(store::ParseTableName(request.name()).status());
  } else if (absl::StartsWith(request.name(), "robots/")) {
    faults.AddAll(store::ParseCalibrationName(request.name()).status());
  } else {
    faults.AddAll(store::ParseSessionName(request.name()).status());
  }
  if (request.offset() < 0) faults.Add("offset", absl::StrCat(request.offset()), "0 or more");
  return faults.ToStatus();
}

// What may change after sealing is no part of it, so that a download goes on whatever happens.
v1::SessionInput HeadOf(v1::Session session) {
  session.clear_revision();
  session.clear_etag();
  session.clear_update_time();
  session.clear_delete_time();
  v1::SessionInput head;
  *head.mutable_session() = std::move(session);
  return head;
}

absl::StatusOr<v1::Session> GetSealed(store::Store& store, const std::string& name) {
  auto session = store.Read([&](Snapshot& snapshot) { return store::GetSession(snapshot, name); });
  if (!session.ok() || session->state() == v1::SEALED) return session;
  return store::Refusal(absl::StatusCode::kFailedPrecondition, "name",
                        absl::StrCat(name, ", which is open"), "a sealed session");
}

absl::StatusOr<v1::CompensationTable> GetReady(store::Store& store, const std::string& name) {
  bool there = false;
  auto table = store.Read([&](Snapshot& snapshot) -> absl::StatusOr<v1::CompensationTable> {
    TRUEPOSE_ASSIGN_OR_RETURN(v1::CompensationTable found, store::GetTable(snapshot, name));
    TRUEPOSE_ASSIGN_OR_RETURN(there, store::HasFile(snapshot, found.sha256()));
    return found;
  });
  if (!table.ok() || (table->state() == v1::TABLE_READY && there)) return table;
  if (table->state() == v1::TABLE_READY)
    return store::Refusal(absl::StatusCode::kFailedPrecondition, "name",
                          absl::StrCat(name, ", which was deleted and whose bytes are gone"),
                          "a table that is there");
  return store::Refusal(
      absl::StatusCode::kFailedPrecondition, "name",
      absl::StrCat(name, ", which is ", v1::CompensationTableState_Name(table->state())),
      "a table that is TABLE_READY");
}

// A page of readings as bytes of a SessionInput, which may be put one behind another.
absl::StatusOr<std::string> ReadPage(store::Store& store, const std::string& session,
                                     std::string& token) {
  TRUEPOSE_ASSIGN_OR_RETURN(store::Page<v1::Reading> page, store.Read([&](Snapshot& snapshot) {
    return store::ListReadings(snapshot, session, {.size = 0, .token = token});
  }));
  v1::SessionInput input;
  for (v1::Reading& reading : page.items) {
    reading.clear_server_time();
    *input.add_readings() = std::move(reading);
  }
  token = std::move(page.next_page_token);
  return store::ToBlob(input);
}

}  // namespace

// The bytes of a SessionInput, which may be put one behind another: the session, then page by page.
absl::StatusOr<Download::Pieces> Download::PiecesOfSession(const CallContext& call,
                                                           const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(v1::Session session, GetSealed(call.store, name));
  return Pieces([&store = call.store, name, head = store::ToBlob(HeadOf(std::move(session))),
                 token = std::string(), ended = false]() mutable -> absl::StatusOr<std::string> {
    if (!head.empty()) return std::exchange(head, "");
    if (ended) return "";
    absl::StatusOr<std::string> piece = ReadPage(store, name, token);
    ended = token.empty();
    return piece;
  });
}

absl::StatusOr<Download::Pieces> Download::PiecesOfTable(const CallContext& call,
                                                         const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::CompensationTable table, GetReady(call.store, name));
  return Pieces([&store = call.store, sha256 = table.sha256(), position = int64_t{0}]() mutable {
    const int64_t next = position++;
    return store.Read([&](Snapshot& snapshot) { return store::ReadPiece(snapshot, sha256, next); });
  });
}

absl::StatusOr<Download::Pieces> Download::PiecesOf(const CallContext& call,
                                                    const std::string& name) {
  if (IsTable(name)) return PiecesOfTable(call, name);
  if (!absl::StartsWith(name, "robots/")) return PiecesOfSession(call, name);
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Calibration calibration, call.store.Read([&](Snapshot& s) {
    return store::GetCalibration(s, name);
  }));
  return Pieces([whole = store::ToBlob(calibration)]() mutable -> absl::StatusOr<std::string> {
    return std::exchange(whole, "");
  });
}

absl::Status Download::Measure(const Pieces& pieces) {
  store::Sha256 sha256;
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const std::string piece, pieces());
    if (piece.empty()) break;
    sha256.Add(piece);
    total_ += static_cast<int64_t>(piece.size());
  }
  sha256_ = sha256.Hex();
  return absl::OkStatus();
}

absl::Status Download::CheckResumed(const v1::DownloadRequest& request) const {
  if (!request.sha256().empty() && request.sha256() != sha256_) {
    return store::Refusal(absl::StatusCode::kAborted, "sha256", request.sha256(),
                          absl::StrCat(sha256_, ": it was changed meanwhile; begin again"));
  }
  if (request.offset() <= total_) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kOutOfRange, "offset", absl::StrCat(request.offset()),
                        absl::StrCat("0 to ", total_, ", the size of the whole"));
}

// Reads until a chunk is there, or the end is reached.
absl::Status Download::Fill() {
  while (waiting_.size() < kChunkBytes) {
    TRUEPOSE_ASSIGN_OR_RETURN(const std::string piece, pieces_());
    if (piece.empty()) return absl::OkStatus();
    waiting_ += piece;
  }
  return absl::OkStatus();
}

absl::Status Download::Skip(int64_t offset) {
  while (offset_ < offset) {
    TRUEPOSE_RETURN_IF_ERROR(Fill());
    if (waiting_.empty()) return absl::DataLossError("a resource became shorter while it was read");
    const size_t skipped = std::min<int64_t>(offset - offset_, waiting_.size());
    waiting_.erase(0, skipped);
    offset_ += static_cast<int64_t>(skipped);
  }
  return absl::OkStatus();
}

absl::StatusOr<std::unique_ptr<Download>> Download::Begin(const CallContext& call,
                                                          const v1::DownloadRequest& request) {
  TRUEPOSE_RETURN_IF_ERROR(CheckRequest(request));
  std::unique_ptr<Download> download(new Download());
  TRUEPOSE_ASSIGN_OR_RETURN(const Pieces measured, PiecesOf(call, request.name()));
  TRUEPOSE_RETURN_IF_ERROR(download->Measure(measured));
  TRUEPOSE_RETURN_IF_ERROR(download->CheckResumed(request));
  TRUEPOSE_ASSIGN_OR_RETURN(download->pieces_, PiecesOf(call, request.name()));
  TRUEPOSE_RETURN_IF_ERROR(download->Skip(request.offset()));
  return download;
}

absl::StatusOr<std::optional<v1::DownloadResponse>> Download::Next() {
  TRUEPOSE_RETURN_IF_ERROR(Fill());
  if (waiting_.empty() && has_sent_) return std::nullopt;
  has_sent_ = true;
  v1::DownloadResponse response;
  response.set_offset(offset_);
  response.set_chunk(waiting_.substr(0, kChunkBytes));
  response.set_total_bytes(total_);
  response.set_sha256(sha256_);
  waiting_.erase(0, kChunkBytes);
  offset_ += static_cast<int64_t>(response.chunk().size());
  return response;
}

}  // namespace truepose::services
