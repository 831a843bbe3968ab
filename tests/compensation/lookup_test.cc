#include "compensation/lookup.h"

#include <gtest/gtest.h>

#include <cmath>

#include "compensation/encode_table.h"
#include "core/base/random.h"
#include "tests/compensation/table_samples.h"

namespace truepose::compensation {
namespace {

// Nodes are float: what is interpolated in float is off by some units of 6e-8 of the largest.
constexpr double kFloat = 1e-6;

// n joints of which the first `unfolded` have 2 to 4 nodes, with random nodes of size 1.
TableContent RandomTable(int n, int unfolded, Random* random) {
  TableContent content;
  content.header.joints = n;
  content.arm.nominal.joints = content.arm.identified.joints = n;
  size_t floats = kNodeFloats;
  for (int i = 0; i < n; ++i) {
    TableAxis& axis = content.axis[i];
    axis.weight[i] = 1;
    if (i > 0) axis.weight[i - 1] = -1;
    axis.lower = random->Uniform(-2, 0);
    axis.upper = random->Uniform(0.5, 2);
    axis.margin = i < unfolded ? 0.1 : 0;
    axis.nodes = i < unfolded ? 2 + static_cast<int>(random->Below(3)) : 1;
    floats *= axis.nodes;
  }
  content.nodes.resize(floats);
  for (float& value : content.nodes) value = static_cast<float>(random->Uniform(-1, 1));
  return content;
}

// Steps from the first node of an axis.
double StepsAlong(const TableAxis& axis, double u) {
  return (u - axis.lower + axis.margin) * (axis.nodes - 1) /
         (axis.upper - axis.lower + 2 * axis.margin);
}

// The definition: a sum over all nodes of products of hats, in double.
Delta InterpolatedByHats(const TableContent& content, const std::vector<double>& u) {
  Delta sum = Delta::Zero();
  for (size_t node = 0; node * kNodeFloats < content.nodes.size(); ++node) {
    double weight = 1;
    size_t rest = node;
    for (int i = content.header.joints - 1; i >= 0; --i) {
      const size_t nodes = content.axis[i].nodes, index = rest % nodes;
      rest /= nodes;
      if (nodes > 1)
        weight *= std::max(0.0, 1 - std::abs(StepsAlong(content.axis[i], u[i]) - index));
    }
    for (int k = 0; k < kNodeFloats; ++k) sum(k) += weight * content.nodes[node * kNodeFloats + k];
  }
  return sum;
}

std::vector<double> RandomCoordinates(const TableContent& content, Random* random) {
  std::vector<double> u;
  for (int i = 0; i < content.header.joints; ++i)
    u.push_back(random->Uniform(content.axis[i].lower, content.axis[i].upper));
  return u;
}

// For each count of unfolded axes, also those without a loop of their own: a wrong stride, corner
// or weight gives another sum.
TEST(LookUp, IsTheSumOfHatsForAnyNumberOfAxes) {
  Random random(11);
  for (int unfolded = 0; unfolded <= 8; ++unfolded) {
    const TableContent content = RandomTable(8, unfolded, &random);
    const Table table = MakeTable(content);
    for (int trial = 0; trial < 20; ++trial) {
      const std::vector<double> u = RandomCoordinates(content, &random);
      const Lookup found = LookUp(table, testing::JointsAt(content, u).data(), Reach::kDomain);
      ASSERT_EQ(found.fault, LookupFault::kNone) << unfolded;
      EXPECT_LT((found.delta - InterpolatedByHats(content, u)).cwiseAbs().maxCoeff(), kFloat)
          << unfolded << " axes";
    }
  }
}

// Folded axes may lie anywhere among the others.
TEST(LookUp, DoesNotAskFoldedAxes) {
  Random random(12);
  TableContent content = testing::SmallTable();
  const Table table = MakeTable(content);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<double> u = RandomCoordinates(content, &random);
    const Delta first = LookUp(table, testing::JointsAt(content, u).data(), Reach::kDomain).delta;
    u[0] = random.Uniform(-3, 3);
    u[5] = random.Uniform(-3, 3);
    const Lookup second = LookUp(table, testing::JointsAt(content, u).data(), Reach::kDomain);
    EXPECT_LT((first - second.delta).cwiseAbs().maxCoeff(), 1e-9 /* float of 1e-3 */);
  }
}

// Each side of each axis, folded or not, a hair inside and outside: the axis is named. Nothing is
// ever extrapolated.
TEST(LookUp, RefusesOutsideOfTheDomain) {
  Random random(13);
  const TableContent content = testing::SmallTable();
  const Table table = MakeTable(content);
  for (int axis = 0; axis < 6; ++axis) {
    for (const double side : {content.axis[axis].lower, content.axis[axis].upper}) {
      const double outwards = side == content.axis[axis].lower ? -1e-6 : 1e-6;
      std::vector<double> u = RandomCoordinates(content, &random);
      u[axis] = side - outwards;
      EXPECT_EQ(LookUp(table, testing::JointsAt(content, u).data(), Reach::kDomain).fault,
                LookupFault::kNone);
      u[axis] = side + outwards;
      const Lookup refused = LookUp(table, testing::JointsAt(content, u).data(), Reach::kDomain);
      EXPECT_EQ(refused.fault, LookupFault::kOutside);
      EXPECT_EQ(refused.axis, axis);
      EXPECT_EQ(refused.delta, Delta::Zero());
    }
  }
}

// Corrected joints are looked up in the margin, up to its end.
TEST(LookUp, ReachesIntoTheMarginForCorrectedJoints) {
  Random random(14);
  const TableContent content = testing::SmallTable();
  const Table table = MakeTable(content);
  for (int axis = 1; axis < 5; ++axis) {
    std::vector<double> u = RandomCoordinates(content, &random);
    u[axis] = content.axis[axis].upper + 0.9 * content.axis[axis].margin;
    const auto inside = testing::JointsAt(content, u);
    EXPECT_EQ(LookUp(table, inside.data(), Reach::kDomain).fault, LookupFault::kOutside);
    const Lookup found = LookUp(table, inside.data(), Reach::kGrid);
    EXPECT_EQ(found.fault, LookupFault::kNone);
    EXPECT_LT((found.delta - InterpolatedByHats(content, u)).cwiseAbs().maxCoeff(), kFloat);
    u[axis] = content.axis[axis].upper + 1.1 * content.axis[axis].margin;
    EXPECT_EQ(LookUp(table, testing::JointsAt(content, u).data(), Reach::kGrid).axis, axis);
  }
}

// Not a number compares as neither inside nor outside; it must not come out as an index.
TEST(LookUp, RefusesWhatIsNoNumber) {
  const TableContent content = testing::SmallTable();
  const Table table = MakeTable(content);
  for (const double bad :
       {std::nan(""), static_cast<double>(INFINITY), -static_cast<double>(INFINITY)}) {
    for (int joint = 0; joint < 6; ++joint) {
      std::array<double, kMaxJoints> q = testing::JointsAt(content, {0, -1, 1, -1.5, -1.5, 0});
      q[joint] = bad;
      const Lookup refused = LookUp(table, q.data(), Reach::kGrid);
      EXPECT_EQ(refused.fault, LookupFault::kNotFinite);
      EXPECT_EQ(refused.delta, Delta::Zero());
    }
  }
}

// The nodes at the ends of the grid are reached, the last cell as well as the first.
TEST(LookUp, GivesTheNodesThemselves) {
  const TableContent content = testing::SmallTable();
  const Table table = MakeTable(content);
  std::vector<double> low(6, 0.0), high(6, 0.0);
  for (int i = 1; i < 5; ++i) {
    low[i] = content.axis[i].lower - content.axis[i].margin + 1e-12;
    high[i] = content.axis[i].upper + content.axis[i].margin - 1e-12;
  }
  const Delta first = LookUp(table, testing::JointsAt(content, low).data(), Reach::kGrid).delta;
  const Delta last = LookUp(table, testing::JointsAt(content, high).data(), Reach::kGrid).delta;
  for (int k = 0; k < kNodeFloats; ++k) {
    EXPECT_NEAR(first(k), content.nodes[k], 1e-9);
    EXPECT_NEAR(last(k), content.nodes[content.nodes.size() - kNodeFloats + k], 1e-9);
  }
}

}  // namespace
}  // namespace truepose::compensation
