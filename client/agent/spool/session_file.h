// One session on the disk: it grows reading by reading and ends with a seal.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "client/agent/spool/disk.h"
#include "client/agent/spool/record.h"
#include "truepose/v1/session.pb.h"

namespace truepose::agent {

// Bytes that all sessions of a spool may have together.
class Budget {
 public:
  explicit Budget(int64_t limit) : limit_(limit) {}
  bool TryTake(int64_t bytes);
  // Without regard to the limit: what is on the disk already, and seals.
  void Take(int64_t bytes) { used_ += bytes; }
  void Give(int64_t bytes) { used_ -= bytes; }
  int64_t used() const { return used_; }
  int64_t limit() const { return limit_; }

 private:
  std::atomic<int64_t> used_{0};
  const int64_t limit_;
};

// May be used by many threads at once; what Append has not answered yet is not read back.
class SessionFile {
 public:
  // `content` has its name, sessions/{uuid}; `request` may be "". Durable with its name when this
  // returns; a failure leaves nothing behind.
  // @returns kResourceExhausted, kUnavailable.
  static absl::StatusOr<std::unique_ptr<SessionFile>> Create(Disk& disk, Budget& budget,
                                                             const std::string& path,
                                                             const v1::Session& content,
                                                             const std::string& request);
  // Reads all of the file and cuts what is behind its last whole record, which was never answered
  // for; the bytes cut are kept durably, in `path` with .cut in place of its suffix, or .cut.2 and
  // so on when that is there. A failure leaves the file as it is.
  // @returns kDataLoss when not even the first record is whole (Create did not return then), and
  //   when whole records stand behind a damaged one, which were answered for; the errors of the
  //   disk, also when it can't be read or has no space for what is cut.
  static absl::StatusOr<std::unique_ptr<SessionFile>> Open(Disk& disk, Budget& budget,
                                                           const std::string& path);
  // Gives its bytes back to the budget; the file stays.
  ~SessionFile();
  SessionFile(const SessionFile&) = delete;
  SessionFile& operator=(const SessionFile&) = delete;

  // As ReadingSink::Append (client/agent/source.h).
  absl::StatusOr<int64_t> Append(int64_t first_number, const std::vector<v1::Reading>& readings);
  // As ReadingSink::Seal; a repeat is OK.
  absl::Status Seal(int64_t readings);
  // Takes no more readings from here on, unless it has one already. @returns whether it is closed.
  bool CloseIfEmpty();
  // At least 1 and at most `most` readings from `number` on, which is at most readings().
  absl::StatusOr<std::vector<v1::Reading>> Read(int64_t number, int most) const;

  const v1::Session& content() const { return content_; }
  const std::string& request() const { return request_; }
  const std::string& path() const { return path_; }
  int64_t readings() const;
  bool sealed() const;
  int64_t bytes() const;
  // Of what Open cut.
  int64_t cut_bytes() const { return cut_bytes_; }

  // What the server said last; not on the disk, since the server is asked again after a start.
  std::atomic<int64_t> delivered{0};
  void SetRefusal(const std::string& text);
  std::string refusal() const;

 private:
  SessionFile(Disk& disk, Budget& budget, std::string path, int descriptor);
  absl::Status Load();
  // Takes over a whole record at `offset`; false when it can't stand there.
  bool Take(const Record& record, int64_t offset);
  absl::Status TakeWholeRecords(int64_t size);
  absl::Status CutTail(int64_t size);
  // What a failed write left behind the end goes. false: errno says why it can't.
  bool CutBack();
  // `records` behind the end, durable, or the file as it was. A seal is not refused by a budget
  // that is used up.
  absl::Status Extend(const std::string& records, bool is_seal = false);
  absl::Status CompareRepeats(int64_t first_number, const std::vector<v1::Reading>& readings,
                              int64_t repeats) const;
  absl::Status CheckNumbers(int64_t first_number, size_t added, int64_t has) const;
  int64_t OffsetNear(int64_t number, int64_t* found) const;
  absl::StatusOr<std::string> ReadBytes(int64_t offset, int64_t size) const;

  Disk& disk_;
  Budget& budget_;
  const std::string path_;
  const int descriptor_;
  v1::Session content_;
  std::string request_;
  int64_t cut_bytes_ = 0;

  std::mutex append_;  // held by who appends, while the disk works
  bool torn_ = false;  // bytes behind end_ that couldn't be cut

  mutable std::mutex mutex_;  // of what follows; never held while the disk writes
  int64_t end_ = 0;           // bytes that are durable and whole
  int64_t readings_ = 0;
  bool sealed_ = false;
  std::string refusal_;
  std::vector<int64_t> index_;                         // offset of readings 1, 1 + kIndexStep...
  mutable int64_t next_number_ = 1, next_offset_ = 0;  // where the last Read ended
};

}  // namespace truepose::agent
