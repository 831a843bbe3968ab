#include "core/base/fault.h"

#include <algorithm>
#include <utility>

#include "absl/strings/cord.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_replace.h"
#include "absl/strings/str_split.h"

namespace truepose {
namespace {

constexpr char kPayloadType[] = "type.truepose/faults";
constexpr char kHiddenType[] = "type.truepose/hidden_faults";
// A file of the wrong kind has a fault in every cell; a person reads the first screens of them.
constexpr size_t kMostFaults = 200;

std::string Escape(const std::string& text) {
  return absl::StrReplaceAll(text, {{"\\", "\\\\"}, {"\t", "\\t"}, {"\n", "\\n"}});
}

std::string Unescape(const std::string& text) {
  return absl::StrReplaceAll(text, {{"\\\\", "\\"}, {"\\t", "\t"}, {"\\n", "\n"}});
}

std::string Encode(const Fault& fault) {
  return absl::StrCat(Escape(fault.field), "\t", Escape(fault.found), "\t", Escape(fault.expected));
}

Fault Decode(absl::string_view line) {
  const std::vector<std::string> parts = absl::StrSplit(line, '\t');
  if (parts.size() != 3) return {};
  return {Unescape(parts[0]), Unescape(parts[1]), Unescape(parts[2])};
}

// How many faults a status stands for beside those it carries.
size_t HiddenFaultsOf(const absl::Status& status) {
  const auto payload = status.GetPayload(kHiddenType);
  size_t hidden = 0;
  if (payload.has_value() && !absl::SimpleAtoi(std::string(*payload), &hidden)) return 0;
  return hidden;
}

}  // namespace

std::string ToString(const Fault& fault) {
  if (fault.expected.empty()) return absl::StrCat(fault.field, ": ", fault.found);
  return absl::StrCat(fault.field, ": found ", fault.found, ", expected ", fault.expected);
}

void FaultList::Add(std::string field, std::string found, std::string expected) {
  Add(Fault{std::move(field), std::move(found), std::move(expected)});
}

void FaultList::Add(Fault fault) { faults_.push_back(std::move(fault)); }

void FaultList::AddAll(const absl::Status& status, std::string_view prefix) {
  if (status.ok()) return;
  const std::vector<Fault> faults = FaultsOf(status);
  hidden_ += HiddenFaultsOf(status);
  if (faults.empty()) Add(std::string(prefix), std::string(status.message()), "");
  for (const Fault& fault : faults)
    Add(std::string(prefix) + fault.field, fault.found, fault.expected);
}

absl::Status FaultList::ToStatus(absl::StatusCode code) const {
  if (empty()) return absl::OkStatus();
  const size_t kept = std::min(faults_.size(), kMostFaults);
  std::vector<std::string> lines, encoded;
  for (size_t i = 0; i < kept; ++i) {
    lines.push_back(ToString(faults_[i]));
    encoded.push_back(Encode(faults_[i]));
  }
  const size_t hidden = faults_.size() - kept + hidden_;
  if (hidden > 0) lines.push_back(absl::StrCat("and ", hidden, " more"));
  absl::Status status(code, absl::StrJoin(lines, "\n"));
  status.SetPayload(kPayloadType, absl::Cord(absl::StrJoin(encoded, "\n")));
  if (hidden > 0) status.SetPayload(kHiddenType, absl::Cord(absl::StrCat(hidden)));
  return status;
}

absl::Status FaultStatus(std::string field, std::string found, std::string expected) {
  FaultList list;
  list.Add(std::move(field), std::move(found), std::move(expected));
  return list.ToStatus();
}

std::vector<Fault> FaultsOf(const absl::Status& status) {
  std::vector<Fault> faults;
  const auto payload = status.GetPayload(kPayloadType);
  if (!payload.has_value()) return faults;
  const std::string text(*payload);
  for (absl::string_view line : absl::StrSplit(text, '\n')) faults.push_back(Decode(line));
  return faults;
}

}  // namespace truepose
