// Tables 2 and 3 as text.
#include <algorithm>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "absl/strings/str_join.h"
#include "client/cli/reproduce.h"
#include "client/cli/table.h"

namespace truepose::cli {
namespace {

std::string Joined(const std::vector<std::string>& names) { return absl::StrJoin(names, " "); }

// Whether the same names, in any order.
bool Same(std::vector<std::string> a, std::vector<std::string> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

std::string Compared(const std::vector<std::string>& found,
                     const std::vector<std::string>& printed) {
  if (printed.empty()) return "not in the table";
  return Same(found, printed) ? "as printed" : absl::StrCat("printed: ", Joined(printed));
}

}  // namespace

std::string Table2Text(const Table2Arguments& arguments, const Table2Result& table) {
  const double degrees = 57.29577951308232;
  Table text({{"column"},
              {"parameter", Align::kLeft},
              {"dx"},
              {"dy"},
              {"dz"},
              {"dalpha"},
              {"dbeta"},
              {"dgamma"},
              {"chapter", Align::kLeft}});
  for (Eigen::Index j = 0; j < table.J.cols(); ++j) {
    std::vector<std::string> cells = {absl::StrCat("j", j + 1), table.names[j]};
    for (int row = 0; row < 6; ++row) cells.push_back(Fixed(table.J(row, j), 4));
    cells.push_back(table.printed[j]);
    text.Add(std::move(cells));
  }
  return absl::StrCat(
      absl::StrFormat("Table 2: q_i = %g deg, q_{i+1} = %g deg, l_i = %g m\n",
                      degrees * arguments.q, degrees * arguments.q_next, arguments.l),
      text.Text(),
      absl::StrFormat("|j5 - j9 - l j12| = %.1e: one of dq_i, dbeta_i%s is redundant\n",
                      table.null_relation.norm(), arguments.l == 0 ? "" : ", db_{i+1}"));
}

std::string Table3Text(const std::vector<Table3Column>& columns) {
  std::string text = "Table 3: parameters of the Stanford arm\n";
  for (const Table3Column& column : columns) {
    absl::StrAppend(&text, "\n", column.model, ": ", column.names.size(), " parameters, ",
                    column.internal, " internal\n  names    ", Joined(column.names),
                    "\n           ", Compared(column.names, column.printed_names), "\n  base     ",
                    Joined(column.base), "\n           ",
                    Compared(column.base, column.printed_base), "\n  gripper  ",
                    Joined(column.gripper), "\n           ",
                    Compared(column.gripper, column.printed_gripper), "\n");
    if (!column.redundant.empty())
      absl::StrAppend(&text, "  dropped  ", absl::StrJoin(column.redundant, "; "), "\n");
  }
  return text;
}

}  // namespace truepose::cli
