#include "tests/agent/released/test_table.h"

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "compensation/encode_table.h"
#include "compensation/sha256.h"
#include "tests/compensation/table_samples.h"

namespace truepose::agent::testing {
namespace {

constexpr char kSerial[] = "A-17";
constexpr double kError = 1e-4;  // rad and m of each parameter, times the calibration's number

template <typename Digest>
std::string Hex(const Digest& digest) {
  return absl::BytesToHexString(
      absl::string_view(reinterpret_cast<const char*>(digest.data()), digest.size()));
}

std::string Sha256Hex(const std::string& bytes) {
  compensation::Sha256 sha256;
  sha256.Add(std::as_bytes(std::span(bytes)));
  return Hex(sha256.Finish());
}

}  // namespace

compensation::Digest DigestOf(const std::string& hex) {
  compensation::Digest digest{};
  const std::string bytes = absl::HexStringToBytes(hex);
  std::copy_n(bytes.begin(), std::min(bytes.size(), digest.size()), digest.begin());
  return digest;
}

compensation::TableContent ContentOf(int calibration, const std::array<int, 4>& nodes) {
  auto content = compensation::testing::Ur10Content(
      compensation::testing::Ur10Arm(kError * calibration), nodes);
  compensation::testing::FillNodes(&content);
  return content;
}

std::string FileOf(const compensation::TableContent& content) {
  const auto bytes = compensation::Encode(content);
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

TestTable::TestTable(int calibration, const std::string& robot)
    : content(ContentOf(calibration, {2, 3, 2, 3})) {
  entry.table = absl::StrCat(robot, "/compensationTables/", calibration);
  entry.calibration = absl::StrCat(robot, "/calibrations/", calibration);
  entry.calibration_digest = Sha256Hex(entry.calibration);
  entry.nominal_digest = Sha256Hex(robot);
  entry.serial = kSerial;
  entry.activated_us = 1'780'000'000'000'000 + calibration;
  entry.revision = 100 + calibration;
  content.header.predicted_accuracy_95_m = 2.5e-4;
  content.header.robot = robot;
  content.header.serial = entry.serial;
  content.header.calibration = entry.calibration;
  content.header.calibration_digest = DigestOf(entry.calibration_digest);
  content.header.nominal_digest = DigestOf(entry.nominal_digest);
  bytes = FileOf(content);
  entry.sha256 = Sha256Hex(bytes);
}

}  // namespace truepose::agent::testing
