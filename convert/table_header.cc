#include "convert/table_header.h"

#include <string>

#include "absl/strings/escaping.h"
#include "compensation/table_layout.h"

namespace truepose::convert {
namespace {

using compensation::Digest;
using compensation::Table;
using compensation::TableHeader;

std::string Hex(const Digest& digest) {
  return absl::BytesToHexString({reinterpret_cast<const char*>(digest.data()), digest.size()});
}

std::string TextOf(const compensation::Text& text) { return std::string(text.view()); }

void FillNames(const TableHeader& from, v1::CompensationTableHeader* to) {
  to->set_schema_version(static_cast<int>(from.schema));
  to->set_robot(TextOf(from.robot));
  to->set_serial(TextOf(from.serial));
  to->set_calibration(TextOf(from.calibration));
  to->set_calibration_digest(Hex(from.calibration_digest));
  to->set_nominal_digest(Hex(from.nominal_digest));
}

void FillAxes(const Table& table, v1::CompensationTableHeader* to) {
  for (int k = 0; k < table.header.joints; ++k) {
    const compensation::TableAxis& axis = table.axis[static_cast<size_t>(k)];
    v1::CompensationTableAxis* message = to->add_axes();
    for (int j = 0; j < table.header.joints; ++j)
      message->add_weights(axis.weight[static_cast<size_t>(j)]);
    message->set_lower(axis.lower);
    message->set_upper(axis.upper);
    message->set_nodes(axis.nodes);
    to->mutable_estimated()->add_nodes(axis.nodes);
  }
}

void FillErrors(const Table& table, v1::CompensationTableHeader* to) {
  const TableHeader& from = table.header;
  to->set_position_tolerance_m(from.tolerance.position_m);
  to->set_rotation_tolerance_rad(from.tolerance.rotation_rad);
  v1::CompensationTableEstimate* estimated = to->mutable_estimated();
  estimated->set_position_m(from.estimated_worst.position_m);
  estimated->set_rotation_rad(from.estimated_worst.rotation_rad);
  estimated->set_size_bytes(
      static_cast<int64_t>(compensation::kNodesAt + table.nodes.size_bytes()));
  v1::CompensationTableError* verified = to->mutable_verified();
  verified->set_worst_position_m(from.worst.position_m);
  verified->set_worst_rotation_rad(from.worst.rotation_rad);
  verified->set_position_95_m(from.percentile_95.position_m);
  verified->set_rotation_95_rad(from.percentile_95.rotation_rad);
  to->set_verification_points(static_cast<int>(from.verification_points));
  if (from.predicted_accuracy_95_m > 0)
    to->set_predicted_accuracy_95_m(from.predicted_accuracy_95_m);
}

}  // namespace

v1::CompensationTableHeader HeaderToProto(const Table& table) {
  v1::CompensationTableHeader header;
  FillNames(table.header, &header);
  FillAxes(table, &header);
  FillErrors(table, &header);
  header.set_smallest_singular_value(table.header.smallest_singular_value);
  header.set_characteristic_length_m(table.header.characteristic_length_m);
  header.set_near_singular_share(table.header.near_singular_share);
  return header;
}

}  // namespace truepose::convert
