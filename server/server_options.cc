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

void CheckAccess(const ServerOptions& options, FaultList& faults) {
  absl::TimeZone zone;
  if (!options.time_zone.empty() && !absl::LoadTimeZone(options.time_zone, &zone))
    faults.Add("time_zone", options.time_zone, "an IANA name such as Europe/Berlin");
  if (options.database == ":memory:" && !options.dev_open)
    faults.Add("database", ":memory:, which keeps no tokens", "a file, or dev_open");
  if (options.bootstrap && options.dev_open)
    faults.Add("bootstrap", "together with dev_open, which asks for no tokens", "one of the two");
}

}  // namespace

absl::Status ServerOptions::Validate() const {
  FaultList faults;
  faults.AddAll(ParseListenAddress(listen).status());
  if (database.empty()) faults.Add("database", "no name", "a file, or :memory:");
  CheckAccess(*this, faults);
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
