#include "server/server_options.h"

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "server/listen_address.h"

namespace truepose::server {
namespace {

void CheckCount(const char* option, int found, int most, FaultList& faults) {
  if (found >= 1 && found <= most) return;
  faults.Add(option, absl::StrCat(found), absl::StrCat("1 to ", most));
}

}  // namespace

absl::Status ServerOptions::Validate() const {
  FaultList faults;
  faults.AddAll(ParseListenAddress(listen).status());
  if (database.empty()) faults.Add("database", "no name", "a file, or :memory:");
  CheckCount("workers", workers, 64, faults);
  CheckCount("handler_threads", handler_threads, 256, faults);
  CheckCount("compute_threads", compute_threads, 64, faults);
  if (drain < absl::ZeroDuration())
    faults.Add("drain", absl::FormatDuration(drain), "not negative");
  if (watch_stall <= absl::ZeroDuration())
    faults.Add("watch_stall", absl::FormatDuration(watch_stall), "more than 0");
  if (schedule <= absl::ZeroDuration())
    faults.Add("schedule", absl::FormatDuration(schedule), "more than 0");
  return faults.ToStatus();
}

}  // namespace truepose::server
