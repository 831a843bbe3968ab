#include "compensation/read_table.h"

#include <cinttypes>

#include "compensation/check_table.h"
#include "compensation/table_digest.h"
#include "compensation/table_fields.h"

namespace truepose::compensation {
namespace {

TableReport CheckBeginning(std::span<const std::byte> file, const TablePrologue& prologue) {
  if (prologue.magic != kTableMagic) {
    return Refused(TableFault::kNotATable,
                   "magic: found other bytes, expected those of a compensation table");
  }
  if (prologue.schema > kTableSchema) {
    return Refused(TableFault::kNewerSchema, "schema: found %" PRIu32 ", expected at most %" PRIu32,
                   prologue.schema, kTableSchema);
  }
  if (file.size() < prologue.total_bytes) {
    return Refused(TableFault::kTruncated, "file: found %zu bytes, expected %" PRIu64, file.size(),
                   prologue.total_bytes);
  }
  if (file.size() > prologue.total_bytes) {
    return Refused(TableFault::kTrailingBytes, "file: found %zu bytes, expected %" PRIu64,
                   file.size(), prologue.total_bytes);
  }
  return {};
}

TableReport CheckWhole(std::span<const std::byte> file, const TablePrologue& prologue) {
  if (file.size() < kNodesAt || prologue.nodes_at != kNodesAt || prologue.schema != kTableSchema ||
      (file.size() - kNodesAt) % (kNodeFloats * sizeof(float)) != 0) {
    return Refused(TableFault::kInvalidField,
                   "sizes: found nodes at %" PRIu32 " of %zu bytes, expected whole nodes at %zu",
                   prologue.nodes_at, file.size(), kNodesAt);
  }
  if (DigestOfTable(file) != prologue.digest)
    return Refused(TableFault::kDamaged, "digest: found another than that of the file's bytes");
  return {};
}

// Bytes between the fields are zero, names end once, flags are 0 or 1.
TableReport CheckCanonical(std::span<const std::byte> file, const TablePrologue& prologue,
                           const Table& table) {
  alignas(8) std::array<std::byte, kNodesAt> again;
  FieldWriter writer(again.data());
  VisitPrologue(writer, prologue);
  VisitFields(writer, table.header, table.arm, table.axis);
  const auto [own, found] = std::mismatch(again.begin(), again.end(), file.begin());
  if (own == again.end()) return {};
  return Refused(TableFault::kInvalidField, "byte %td: found %u, expected %u", own - again.begin(),
                 std::to_integer<unsigned>(*found), std::to_integer<unsigned>(*own));
}

std::span<const float> NodesOf(std::span<const std::byte> file) {
  const std::span<const std::byte> bytes = file.subspan(kNodesAt);
  return {reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)};
}

TableReport CheckExpectation(const TableHeader& header, const TableExpectation& expectation) {
  const std::string_view serial = header.serial.view();
  if (!expectation.serial.empty() && serial != expectation.serial) {
    return Refused(TableFault::kOtherRobot, "serial: found '%.64s', expected '%.*s'",
                   header.serial.c_str(),
                   static_cast<int>(std::min<std::size_t>(expectation.serial.size(), 64)),
                   expectation.serial.data());
  }
  if (expectation.nominal_digest && *expectation.nominal_digest != header.nominal_digest)
    return Refused(TableFault::kOtherNominal,
                   "nominal_digest: found that of another nominal robot");
  if (expectation.calibration_digest &&
      *expectation.calibration_digest != header.calibration_digest) {
    return Refused(TableFault::kOtherCalibration,
                   "calibration_digest: found that of another calibration");
  }
  return {};
}

TableReport CheckFields(std::span<const std::byte> file, const TablePrologue& prologue,
                        const Table& fields) {
  const TableReport report = CheckTable(fields.header, fields.arm, fields.axis, NodesOf(file));
  return report.ok() ? CheckCanonical(file, prologue, fields) : report;
}

Table FieldsOf(std::span<const std::byte> file) {
  Table fields;
  FieldReader reader(file.data() + kFieldsAt);
  VisitFields(reader, fields.header, fields.arm, fields.axis);
  fields.arm.nominal.joints = fields.arm.identified.joints = fields.header.joints;
  return fields;
}

}  // namespace

TableReport ReadTable(std::span<const std::byte> file, const TableExpectation& expectation,
                      Table* table) noexcept {
  if (file.size() < kFieldsAt) {
    return Refused(TableFault::kTruncated, "file: found %zu bytes, expected at least %zu",
                   file.size(), kNodesAt);
  }
  TablePrologue prologue;
  FieldReader reader(file.data());
  VisitPrologue(reader, prologue);
  if (TableReport r = CheckBeginning(file, prologue); !r.ok()) return r;
  if (TableReport r = CheckWhole(file, prologue); !r.ok()) return r;
  const Table fields = FieldsOf(file);
  if (TableReport r = CheckFields(file, prologue, fields); !r.ok()) return r;
  if (TableReport r = CheckExpectation(fields.header, expectation); !r.ok()) return r;
  *table = MakeTable(fields.header, fields.arm, fields.axis, NodesOf(file));
  return {};
}

}  // namespace truepose::compensation
