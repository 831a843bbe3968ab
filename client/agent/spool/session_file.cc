#include "client/agent/spool/session_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "absl/strings/str_cat.h"
#include "core/base/error_metadata.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr std::string_view kMagic = "TPSPOOL1";
constexpr int64_t kIndexStep = 256;
// Holds at least one record of the largest size.
constexpr size_t kChunk = 2 * kLargestRecord;
constexpr size_t kReadAhead = 128 << 10;

std::string CutPath(const std::string& path) { return path.substr(0, path.rfind('.')) + ".cut"; }

std::string PayloadOf(const v1::Reading& reading) {
  if (reading.row() == 0 && !reading.has_server_time()) return reading.SerializeAsString();
  v1::Reading bare = reading;
  bare.clear_row();
  bare.clear_server_time();
  return bare.SerializeAsString();
}

absl::Status NumberRefusal(absl::StatusCode code, std::string found, std::string expected) {
  FaultList faults;
  faults.Add("number", std::move(found), std::move(expected));
  return faults.ToStatus(code);
}

}  // namespace

bool Budget::TryTake(int64_t bytes) {
  if ((used_ += bytes) <= limit_) return true;
  used_ -= bytes;
  return false;
}

SessionFile::SessionFile(Disk& disk, Budget& budget, std::string path, int descriptor)
    : disk_(disk), budget_(budget), path_(std::move(path)), descriptor_(descriptor) {}

SessionFile::~SessionFile() {
  budget_.Give(end_);
  close(descriptor_);
}

absl::StatusOr<std::unique_ptr<SessionFile>> SessionFile::Create(Disk& disk, Budget& budget,
                                                                 const std::string& path,
                                                                 const v1::Session& content,
                                                                 const std::string& request) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (descriptor < 0) return DiskError(path);
  std::unique_ptr<SessionFile> file(new SessionFile(disk, budget, path, descriptor));
  std::string bytes(kMagic);
  AppendRecord(RecordKind::kBegin, content.SerializeAsString(), &bytes);
  if (!request.empty()) AppendRecord(RecordKind::kRequest, request, &bytes);
  absl::Status status = file->Extend(bytes);
  if (status.ok()) status = SyncFolder(disk, path.substr(0, path.rfind('/')));
  if (!status.ok()) {
    unlink(path.c_str());
    return status;
  }
  file->content_ = content;
  file->request_ = request;
  return file;
}

absl::StatusOr<std::unique_ptr<SessionFile>> SessionFile::Open(Disk& disk, Budget& budget,
                                                               const std::string& path) {
  const int descriptor = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (descriptor < 0) return DiskError(path);
  std::unique_ptr<SessionFile> file(new SessionFile(disk, budget, path, descriptor));
  TRUEPOSE_RETURN_IF_ERROR(file->Load());
  return file;
}

absl::StatusOr<std::string> SessionFile::ReadBytes(int64_t offset, int64_t size) const {
  return ReadWhole(disk_, descriptor_, offset, static_cast<size_t>(size), path_);
}

absl::Status SessionFile::Load() {
  struct stat status {};
  if (fstat(descriptor_, &status) != 0) return DiskError(path_);
  const auto magic = static_cast<int64_t>(kMagic.size());
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string begin,
                            ReadBytes(0, std::min<int64_t>(magic, status.st_size)));
  if (begin != kMagic) return absl::DataLossError(path_ + ": no spool file");
  TRUEPOSE_RETURN_IF_ERROR(TakeWholeRecords(status.st_size));
  if (content_.name().empty()) return absl::DataLossError(path_ + ": its begin is not whole");
  budget_.Take(end_);
  return CutTail(status.st_size);
}

absl::Status SessionFile::TakeWholeRecords(int64_t size) {
  int64_t offset = kMagic.size();
  for (bool whole = true; whole;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const std::string chunk,
                              ReadBytes(offset, std::min<int64_t>(kChunk, size - offset)));
    size_t used = 0;
    while (used < chunk.size()) {
      const auto record = ParseRecord(std::string_view(chunk).substr(used));
      if (!record || !Take(*record, offset + static_cast<int64_t>(used))) break;
      used += record->size();
    }
    whole = used > 0;
    offset += static_cast<int64_t>(used);
  }
  if (!content_.name().empty()) end_ = offset;
  return absl::OkStatus();
}

bool SessionFile::Take(const Record& record, int64_t offset) {
  const bool first = content_.name().empty();
  if (first || sealed_) {
    return first && record.kind == RecordKind::kBegin &&
           content_.ParseFromArray(record.payload.data(), static_cast<int>(record.payload.size()));
  }
  switch (record.kind) {
    case RecordKind::kRequest:
      request_ = std::string(record.payload);
      return true;
    case RecordKind::kReading:
      if (readings_++ % kIndexStep == 0) index_.push_back(offset);
      return true;
    case RecordKind::kSeal:
      sealed_ = true;
      return true;
    default:
      return false;
  }
}

absl::Status SessionFile::CutTail(int64_t size) {
  if (size == end_) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string tail, ReadBytes(end_, size - end_));
  // A torn write ends the file; what is whole behind the damage was answered for.
  if (HoldsRecord(std::string_view(tail).substr(1))) {
    return absl::DataLossError(absl::StrCat(path_, ": damaged behind reading ", readings_,
                                            ", at byte ", end_, ", with whole records behind it"));
  }
  TRUEPOSE_RETURN_IF_ERROR(WriteNewFile(disk_, FreshPath(CutPath(path_)), tail));
  if (!CutBack()) return DiskError(path_);
  cut_bytes_ = size - end_;
  return absl::OkStatus();
}

bool SessionFile::CutBack() {
  return disk_.Truncate(descriptor_, end_) == 0 && disk_.Sync(descriptor_) == 0;
}

absl::Status SessionFile::Extend(const std::string& records, bool is_seal) {
  if (torn_ && !CutBack()) return DiskError(path_);
  torn_ = false;
  const auto size = static_cast<int64_t>(records.size());
  if (is_seal) {
    budget_.Take(size);
  } else if (!budget_.TryTake(size)) {
    return absl::ResourceExhaustedError(
        absl::StrCat("the spool is full: ", budget_.used(), " of ", budget_.limit(), " bytes"));
  }
  const absl::Status status = WriteDurably(disk_, descriptor_, records, end_, path_);
  if (!status.ok()) {
    budget_.Give(size);
    torn_ = !CutBack();
    return status;
  }
  std::lock_guard lock(mutex_);
  end_ += size;
  return absl::OkStatus();
}

absl::Status SessionFile::CheckNumbers(int64_t first_number, size_t added, int64_t has) const {
  if (first_number < 1 || first_number > has + 1) {
    return WithErrorMetadata(
        NumberRefusal(absl::StatusCode::kOutOfRange, absl::StrCat(first_number),
                      absl::StrCat("1 to ", has + 1, ", the next of this session")),
        "expected_number", absl::StrCat(has + 1));
  }
  if (added == 0 || !sealed()) return absl::OkStatus();
  return NumberRefusal(absl::StatusCode::kFailedPrecondition,
                       absl::StrCat(has + 1, " of a sealed session"),
                       absl::StrCat("at most ", has, ", or a new session"));
}

absl::Status SessionFile::CompareRepeats(int64_t first_number,
                                         const std::vector<v1::Reading>& readings,
                                         int64_t repeats) const {
  for (int64_t i = 0; i < repeats;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const auto stored,
                              Read(first_number + i, static_cast<int>(repeats - i)));
    for (const v1::Reading& reading : stored) {
      if (reading.SerializeAsString() != PayloadOf(readings[i])) {
        return NumberRefusal(absl::StatusCode::kAborted,
                             absl::StrCat(first_number + i, ", which is stored with other values"),
                             "a number for one reading only");
      }
      ++i;
    }
  }
  return absl::OkStatus();
}

absl::StatusOr<int64_t> SessionFile::Append(int64_t first_number,
                                            const std::vector<v1::Reading>& readings) {
  std::lock_guard appending(append_);
  const int64_t has = this->readings();
  const auto size = static_cast<int64_t>(readings.size());
  const int64_t repeats =
      std::clamp<int64_t>(has + 1 - std::max<int64_t>(0, first_number), 0, size);
  TRUEPOSE_RETURN_IF_ERROR(CheckNumbers(first_number, readings.size() - repeats, has));
  TRUEPOSE_RETURN_IF_ERROR(CompareRepeats(first_number, readings, repeats));
  if (repeats == size) return has;
  std::string records;
  std::vector<int64_t> offsets;
  for (int64_t i = repeats; i < size; ++i) {
    if ((has + i - repeats) % kIndexStep == 0)
      offsets.push_back(static_cast<int64_t>(records.size()));
    const std::string payload = PayloadOf(readings[i]);
    if (payload.size() > kLargestRecord)
      return FaultStatus(absl::StrCat("readings[", i, "]"), absl::StrCat(payload.size(), " bytes"),
                         absl::StrCat("at most ", kLargestRecord));
    AppendRecord(RecordKind::kReading, payload, &records);
  }
  const int64_t begin = end_;
  TRUEPOSE_RETURN_IF_ERROR(Extend(records));
  std::lock_guard lock(mutex_);
  for (const int64_t offset : offsets) index_.push_back(begin + offset);
  return readings_ += size - repeats;
}

absl::Status SessionFile::Seal(int64_t readings) {
  std::lock_guard appending(append_);
  const int64_t has = this->readings();
  if (readings != has || has == 0) {
    return FaultStatus("readings", absl::StrCat(readings),
                       has == 0 ? "at least one reading" : absl::StrCat(has, ", as there are"));
  }
  if (sealed()) return absl::OkStatus();
  std::string record;
  AppendRecord(RecordKind::kSeal, "", &record);
  // A full spool must not keep a session from its end.
  TRUEPOSE_RETURN_IF_ERROR(Extend(record, /*is_seal=*/true));
  std::lock_guard lock(mutex_);
  sealed_ = true;
  return absl::OkStatus();
}

bool SessionFile::CloseIfEmpty() {
  std::lock_guard appending(append_);
  std::lock_guard lock(mutex_);
  if (readings_ == 0) sealed_ = true;
  return readings_ == 0;
}

int64_t SessionFile::OffsetNear(int64_t number, int64_t* found) const {
  if (number == next_number_ && next_offset_ > 0) {
    *found = number;
    return next_offset_;
  }
  const int64_t step = (number - 1) / kIndexStep;
  *found = 1 + step * kIndexStep;
  return index_[static_cast<size_t>(step)];
}

absl::StatusOr<std::vector<v1::Reading>> SessionFile::Read(int64_t number, int most) const {
  int64_t at = 0, offset = 0, end = 0;
  {
    std::lock_guard lock(mutex_);
    if (number < 1 || number > readings_ || most < 1)
      return absl::OutOfRangeError(absl::StrCat("reading ", number, " of ", readings_));
    most = static_cast<int>(std::min<int64_t>(most, readings_ - number + 1));
    offset = OffsetNear(number, &at);
    end = end_;
  }
  std::vector<v1::Reading> readings;
  for (size_t size = kReadAhead; readings.empty(); size = kChunk) {
    TRUEPOSE_ASSIGN_OR_RETURN(
        const std::string chunk,
        ReadBytes(offset, std::min(static_cast<int64_t>(size), end - offset)));
    size_t used = 0;
    while (static_cast<int>(readings.size()) < most) {
      const auto record = ParseRecord(std::string_view(chunk).substr(used));
      if (!record || record->kind != RecordKind::kReading) break;
      used += record->size();
      if (at++ < number) continue;
      readings.emplace_back().ParseFromArray(record->payload.data(),
                                             static_cast<int>(record->payload.size()));
    }
    if (used == 0 && size == kChunk) return absl::DataLossError(path_ + ": can't be read back");
    offset += static_cast<int64_t>(used);
  }
  std::lock_guard lock(mutex_);
  next_number_ = at;
  next_offset_ = offset;
  return readings;
}

int64_t SessionFile::readings() const {
  std::lock_guard lock(mutex_);
  return readings_;
}

bool SessionFile::sealed() const {
  std::lock_guard lock(mutex_);
  return sealed_;
}

int64_t SessionFile::bytes() const {
  std::lock_guard lock(mutex_);
  return end_;
}

void SessionFile::SetRefusal(const std::string& text) {
  std::lock_guard lock(mutex_);
  refusal_ = text;
}

std::string SessionFile::refusal() const {
  std::lock_guard lock(mutex_);
  return refusal_;
}

}  // namespace truepose::agent
