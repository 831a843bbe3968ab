#include "core/reproduce/table2.h"

#include <gtest/gtest.h>

#include <cmath>

namespace truepose {
namespace {

using Column = Eigen::Matrix<double, 6, 1>;

Column Of(double x, double y, double z, double a, double b, double c) {
  Column column;
  column << x, y, z, a, b, c;
  return column;
}

// The twelve printed columns with the entries that the scan has lost. Would catch a column at
// another frame, a row order, and q_{i+1} turned the other way.
TEST(Table2, HasTheChaptersColumns) {
  const double q = 0.7, p = -0.4, l = 0.32;
  const Table2Result table = Table2({q, p, l, 0.33});
  const double C = std::cos(q), S = std::sin(q), c = std::cos(p), s = std::sin(p);
  const std::vector<Column> printed = {
      Of(1, 0, 0, 0, 0, 0),   Of(0, 1, 0, 0, 0, 0),         Of(0, 0, 0, 1, 0, 0),
      Of(0, 0, 0, 0, 1, 0),   Of(0, 0, 0, 0, 0, 1),         Of(C, S, 0, 0, 0, 0),
      Of(0, 0, 1, 0, 0, 0),   Of(0, 0, 0, C, S, 0),         Of(l * S, -l * C, 0, 0, 0, 1),
      Of(0, 0, -l, S, -C, 0), Of(C * c, S * c, s, 0, 0, 0), Of(-S, C, 0, 0, 0, 0)};
  ASSERT_EQ(table.J.cols(), 15);
  for (size_t j = 0; j < printed.size(); ++j) {
    EXPECT_LT((table.J.col(static_cast<Eigen::Index>(j)) - printed[j]).norm(), 1e-15)
        << "j" << j + 1 << ": " << table.J.col(static_cast<Eigen::Index>(j)).transpose();
  }
  EXPECT_EQ(table.names[4], "dq_i");
  EXPECT_EQ(table.names[8], "dbeta_i");
  EXPECT_EQ(table.names[11], "db_{i+1}");
}

// For any arguments; would catch a relation that holds at the example's angles only.
TEST(Table2, ItsNullRelationHolds) {
  for (double q : {0.0, 0.7, -2.1}) {
    for (double p : {0.0, 1.3}) {
      for (double l : {0.0, 0.32}) EXPECT_LT(Table2({q, p, l, 0.1}).null_relation.norm(), 1e-15);
    }
  }
}

}  // namespace
}  // namespace truepose
