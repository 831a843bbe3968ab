#include "client/cli/outcome.h"

#include "absl/strings/cord.h"
#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "client/cli/json.h"
#include "client/exit_codes.h"
#include "core/base/fault.h"

namespace truepose::cli {
namespace {

constexpr char kUsagePayload[] = "type.truepose/usage";
constexpr char kAnsweredPayload[] = "type.truepose/answered";
constexpr char kHintPayload[] = "type.truepose/hint";

// The same status with another code or message; an absl::Status can't be changed in place.
absl::Status Copy(const absl::Status& status, absl::StatusCode code, absl::string_view message) {
  absl::Status copy(code, message);
  status.ForEachPayload(
      [&](absl::string_view type, const absl::Cord& payload) { copy.SetPayload(type, payload); });
  return copy;
}

}  // namespace

absl::Status UsageError(absl::string_view message) {
  absl::Status status = absl::InvalidArgumentError(message);
  status.SetPayload(kUsagePayload, absl::Cord());
  return status;
}

absl::Status OptionFault(absl::string_view option, absl::string_view found,
                         absl::string_view expected) {
  return FaultStatus(std::string(option), absl::StrCat("'", found, "'"), std::string(expected));
}

absl::Status AsInputFault(const absl::Status& status) {
  if (status.ok()) return status;
  return Copy(status, absl::StatusCode::kInvalidArgument, status.message());
}

absl::Status AnsweredFailure(absl::string_view message) {
  absl::Status status = absl::AbortedError(message);
  status.SetPayload(kAnsweredPayload, absl::Cord());
  return status;
}

absl::Status AsFaultOfInput(const absl::Status& status) {
  const bool of_input =
      status.code() == absl::StatusCode::kFailedPrecondition && !FaultsOf(status).empty();
  return of_input ? AsInputFault(status) : status;
}

absl::Status WithHint(const absl::Status& status, absl::StatusCode code, absl::string_view hint) {
  if (status.code() != code || status.GetPayload(kHintPayload).has_value()) return status;
  absl::Status hinted = Copy(status, code, absl::StrCat(status.message(), "\n", hint));
  if (code == absl::StatusCode::kNotFound) hinted.SetPayload(kHintPayload, absl::Cord(hint));
  return hinted;
}

absl::Status WithFaults(const absl::Status& status, const FaultList& faults) {
  const auto hint = status.GetPayload(kHintPayload);
  const absl::Status other = faults.ToStatus(status.code());
  return hint ? WithHint(other, status.code(), std::string(*hint)) : other;
}

absl::Status RenameFields(const absl::Status& status, const Renaming& renaming) {
  FaultList faults;
  for (Fault fault : FaultsOf(status)) {
    for (const auto& [beginning, name] : renaming) {
      if (!absl::StartsWith(fault.field, beginning)) continue;
      fault.field.replace(0, beginning.size(), name);
      break;
    }
    faults.Add(std::move(fault));
  }
  return faults.empty() ? status : WithFaults(status, faults);
}

int ExitCodeOf(const absl::Status& status) {
  switch (status.code()) {
    case absl::StatusCode::kOk:
      return client::kExitOk;
    case absl::StatusCode::kInvalidArgument:
      return status.GetPayload(kUsagePayload).has_value() ? client::kExitUsage : client::kExitInput;
    case absl::StatusCode::kOutOfRange:
    case absl::StatusCode::kAlreadyExists:
      return client::kExitInput;
    case absl::StatusCode::kUnavailable:
    case absl::StatusCode::kDeadlineExceeded:
      return client::kExitUnavailable;
    case absl::StatusCode::kDataLoss:
      return client::kExitDatabase;
    case absl::StatusCode::kUnauthenticated:
    case absl::StatusCode::kPermissionDenied:
      return client::kExitNotAllowed;
    case absl::StatusCode::kNotFound:
      return client::kExitNotFound;
    default:
      return client::kExitRunFailed;
  }
}

void PrintError(const Console& console, bool json, const absl::Status& status) {
  if (status.ok()) return;
  const bool several = FaultsOf(status).size() > 1;
  if (several) console.err << "truepose: " << FaultsOf(status).size() << " faults\n";
  const std::string indented = absl::StrReplaceAll(status.message(), {{"\n", "\n  "}});
  console.err << (several ? "  " : "truepose: ") << indented << "\n";
  if (json && !status.GetPayload(kAnsweredPayload)) console.out << ErrorJson(status) << "\n";
}

}  // namespace truepose::cli
