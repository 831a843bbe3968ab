#include "absl/strings/cord.h"
#include "server/store/sql/connection.h"

namespace truepose::store::sql {
namespace {

// kAborted alone isn't enough: a repository answers it, too, for rows that contradict stored ones.
constexpr char kRetryType[] = "type.truepose/sql-retry";

}  // namespace

absl::Status Retryable(std::string_view message) {
  absl::Status status = absl::AbortedError(std::string(message));
  status.SetPayload(kRetryType, absl::Cord("1"));
  return status;
}

bool IsRetryable(const absl::Status& status) { return status.GetPayload(kRetryType).has_value(); }

}  // namespace truepose::store::sql
