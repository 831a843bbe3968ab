#include "client/agent/released/released_set.h"

#include <array>
#include <fstream>
#include <optional>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "compensation/sha256.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

using compensation::TableFault;
using compensation::TableReport;

std::optional<compensation::Digest> DigestOf(const std::string& hex) {
  const std::string bytes = absl::HexStringToBytes(hex);
  compensation::Digest digest;
  if (bytes.size() != digest.size()) return std::nullopt;
  std::copy(bytes.begin(), bytes.end(), digest.begin());
  return digest;
}

absl::StatusOr<std::string> Sha256OfFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return absl::UnavailableError(absl::StrCat(path, " can't be read"));
  compensation::Sha256 digest;
  std::array<char, 65'536> piece;
  while (file.read(piece.data(), piece.size()) || file.gcount() > 0)
    digest.Add(std::as_bytes(std::span(piece.data(), static_cast<size_t>(file.gcount()))));
  const auto found = digest.Finish();
  return absl::BytesToHexString(
      absl::string_view(reinterpret_cast<const char*>(found.data()), found.size()));
}

absl::Status ToStatus(const TableReport& report) {
  const std::string text =
      absl::StrCat(compensation::Name(report.fault), ": ", report.message.data());
  switch (report.fault) {
    case TableFault::kNone:
      return absl::OkStatus();
    case TableFault::kNotOpened:
    case TableFault::kNoMemory:
      return absl::UnavailableError(text);
    case TableFault::kNotATable:
    case TableFault::kTruncated:
    case TableFault::kTrailingBytes:
    case TableFault::kDamaged:
      return absl::DataLossError(text);
    default:
      return absl::FailedPreconditionError(text);
  }
}

absl::Status CheckBytes(const std::string& path, const std::string& expected) {
  TRUEPOSE_ASSIGN_OR_RETURN(const std::string found, Sha256OfFile(path));
  if (found == expected) return absl::OkStatus();
  return absl::DataLossError(
      absl::StrCat("sha256: found ", found, ", expected ", expected, ", as released"));
}

}  // namespace

// What a table says of itself comes first: "another robot's" tells more than other bytes do.
absl::StatusOr<std::shared_ptr<const ReleasedSet>> ReleasedSet::Map(const std::string& path,
                                                                    const std::string& robot,
                                                                    const ReleasedEntry& entry) {
  std::shared_ptr<ReleasedSet> set(new ReleasedSet(path, entry));
  compensation::TableExpectation expectation;
  expectation.serial = set->entry_.serial;
  expectation.nominal_digest = DigestOf(entry.nominal_digest);
  expectation.calibration_digest = DigestOf(entry.calibration_digest);
  TRUEPOSE_RETURN_IF_ERROR(
      ToStatus(compensation::TableFile::Map(path.c_str(), expectation, &set->file_)));
  const std::string_view found = set->table().header.robot.view();
  if (found != robot)
    return absl::FailedPreconditionError(
        absl::StrCat("another robot's: found ", std::string(found), ", expected ", robot));
  TRUEPOSE_RETURN_IF_ERROR(CheckBytes(path, entry.sha256));
  return std::shared_ptr<const ReleasedSet>(std::move(set));
}

}  // namespace truepose::agent
