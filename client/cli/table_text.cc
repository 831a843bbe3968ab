#include "client/cli/table_text.h"

#include <cmath>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "client/cli/table.h"

namespace truepose::cli {
namespace {

constexpr char kIndent[] = "  ";
constexpr double kDegPerRad = 57.29577951308232;

std::string Mm(double length_m) { return absl::StrCat(Fixed(1e3 * length_m, 4), " mm"); }
std::string Deg(double angle_rad) { return absl::StrCat(Fixed(kDegPerRad * angle_rad, 5), " deg"); }

std::string Or(const std::string& text, const char* otherwise) {
  return text.empty() ? otherwise : text;
}

std::string ForWhat(const v1::CompensationTableHeader& header) {
  return absl::StrCat(
      "Compensation table of ", Or(header.robot(), "an unnamed robot"),
      header.serial().empty() ? "" : absl::StrCat(", serial ", header.serial()), "\n", kIndent,
      "calibration ", Or(header.calibration(), "of a file"), ", ", header.calibration_digest(),
      "\n", kIndent, "nominal     ", header.nominal_digest(), "\n", kIndent, "schema ",
      header.schema_version(), ", ",
      Fixed(static_cast<double>(header.estimated().size_bytes()) / (1 << 20), 2), " MB\n");
}

std::string ErrorTable(const v1::CompensationTableHeader& header) {
  Table table({{"error against exact", Align::kLeft}, {"position"}, {"orientation"}});
  table.Add({"allowed", Mm(header.position_tolerance_m()), Deg(header.rotation_tolerance_rad())});
  table.Add({"estimated worst", Mm(header.estimated().position_m()),
             Deg(header.estimated().rotation_rad())});
  table.Add({"verified worst", Mm(header.verified().worst_position_m()),
             Deg(header.verified().worst_rotation_rad())});
  table.Add({"verified 95 %", Mm(header.verified().position_95_m()),
             Deg(header.verified().rotation_95_rad())});
  return absl::StrCat(table.Text(kIndent), kIndent, "verified at ",
                      Count(header.verification_points(), "other point"), " of the domain\n");
}

// The units of a coordinate are not in the message: rad but for sliding joints alone, so both.
std::string AxesTable(const v1::CompensationTableHeader& header) {
  Table table(
      {{"coordinate", Align::kLeft}, {"from rad|m"}, {"to rad|m"}, {"nodes"}, {"", Align::kLeft}});
  for (const v1::CompensationTableAxis& axis : header.axes())
    table.Add({CoordinateText(axis), Fixed(axis.lower(), 4), Fixed(axis.upper(), 4),
               absl::StrCat(axis.nodes()), axis.nodes() == 1 ? "does not matter" : ""});
  return table.Text(kIndent);
}

std::string Limits(const v1::CompensationTableHeader& header) {
  std::string text = absl::StrCat(
      "Refused outside of the domain, and near a singularity: where the smallest singular value\n"
      "is below ",
      header.smallest_singular_value(), " (lengths over ",
      Fixed(header.characteristic_length_m(), 3), " m), ",
      Fixed(100 * header.near_singular_share(), 1), " % of the domain\n");
  if (header.unreachable_share() > 0)
    absl::StrAppend(&text, Fixed(100 * header.unreachable_share(), 1),
                    " % of the poses asked for are not reached in this configuration\n");
  if (header.has_predicted_accuracy_95_m())
    absl::StrAppend(&text, "Predicted accuracy of the compensated tool (95 %): ",
                    Fixed(1e3 * header.predicted_accuracy_95_m(), 3), " mm\n");
  return text;
}

}  // namespace

std::string CoordinateText(const v1::CompensationTableAxis& axis) {
  std::string text;
  for (int j = 0; j < axis.weights_size(); ++j) {
    const double weight = axis.weights(j);
    if (weight == 0) continue;
    absl::StrAppend(&text, text.empty() ? (weight < 0 ? "-" : "") : (weight < 0 ? " - " : " + "));
    if (std::abs(weight) != 1) absl::StrAppend(&text, std::abs(weight), " ");
    absl::StrAppend(&text, "q", j + 1);
  }
  return text;
}

std::string TableText(const v1::CompensationTableHeader& header) {
  return absl::StrCat(ForWhat(header), "\n", ErrorTable(header), "\nDomain, chain joints\n",
                      AxesTable(header), "\n", Limits(header));
}

}  // namespace truepose::cli
