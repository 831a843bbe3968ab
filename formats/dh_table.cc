#include "formats/dh_table.h"

#include <vector>

#include "formats/csv.h"
#include "formats/number.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

std::string Line(const std::string& link, const std::string& joint, const std::string& type,
                 const v1::DhRow& row) {
  return CsvLine({link, joint, type, FormatNumber(row.theta_rad()), FormatNumber(row.d_m()),
                  FormatNumber(row.a_m()), FormatNumber(row.alpha_rad())});
}

}  // namespace

std::string WriteDhTable(const v1::Nominal& nominal, const v1::DhTable& table) {
  std::string out = CsvLine({"link", "joint", "type", "theta_rad", "d_m", "a_m", "alpha_rad"});
  const int n = nominal.joints_size();
  out += Line("0", "base", "constant", table.rows(0));
  for (int i = 0; i < n; ++i) {
    const v1::Joint& joint = nominal.joints(i);
    out += Line(StrCat(i + 1), joint.name(),
                joint.type() == v1::PRISMATIC ? "prismatic" : "revolute", table.rows(i + 1));
  }
  return out + Line("", "flange", "constant", table.rows(n + 1));
}

}  // namespace truepose::formats
