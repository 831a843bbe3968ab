#include "core/identification/identifiability.h"

#include <gtest/gtest.h>

#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

ParameterSet Names(const std::vector<Parameter>& parameters) {
  ParameterSet set;
  for (const Parameter& parameter : parameters) set.Add(parameter);
  return set;
}

Parameter Angle(const std::string& name) {
  return {name, ParameterGroup::kInternal, ParameterRole::kAngle, Unit::kRadian};
}
Parameter Offset(const std::string& name) {
  return {name, ParameterGroup::kInternal, ParameterRole::kJointOffset, Unit::kRadian};
}
Parameter Length(const std::string& name) {
  return {name, ParameterGroup::kInternal, ParameterRole::kLength, Unit::kMetre};
}
Parameter Base(const std::string& name) {
  return {name, ParameterGroup::kBase, ParameterRole::kExternal, Unit::kMetre};
}

Eigen::MatrixXd RandomColumns(int rows, int columns) {
  Random random(61);
  Eigen::MatrixXd J(rows, columns);
  for (Eigen::Index i = 0; i < J.size(); ++i) J(i) = 1e3 * random.Uniform(-1, 1);
  return J;
}

// Of equals the preferred kind stays, not the one that stands first: offsets before lengths before
// angles, frames before all.
TEST(Identifiable, OrderOfPreference) {
  Eigen::MatrixXd J = RandomColumns(40, 4);
  J.col(1) = J.col(0);
  J.col(3) = J.col(2);
  const IdentifiableSet set =
      Identifiable(J, Names({Angle("dbeta1"), Offset("dq1"), Length("da1"), Base("base.x")}), {});
  EXPECT_EQ(set.active, (std::vector<int>{1, 3}));
  ASSERT_EQ(set.redundancies.size(), 2u);
}

// The relation has the coefficients that make it true, in SI units.
TEST(Identifiable, RelationIsExact) {
  Eigen::MatrixXd J = RandomColumns(40, 3);
  J.col(2) = 2 * J.col(0) - 0.25 * J.col(1);
  const ParameterSet names = Names({Offset("dq1"), Length("da2"), Angle("dbeta1")});
  const IdentifiableSet set = Identifiable(J, names, {});
  ASSERT_EQ(set.redundancies.size(), 1u);
  const NullRelation& relation = set.redundancies[0];
  EXPECT_EQ(relation.dropped, 2);
  ASSERT_EQ(relation.kept.size(), 2u);
  EXPECT_NEAR(relation.kept[0].second, 2, 1e-12);
  EXPECT_NEAR(relation.kept[1].second, -0.25, 1e-12);
  EXPECT_EQ(RelationText(relation, names), "dbeta1 = +2 dq1 and -250 mm/rad da2");
  EXPECT_NE(ReasonText(relation, names).find("at these poses"), std::string::npos);
}

// A column of size 1e-14 beside others of 1e3 is a gauge, not a direction: scaled to norm 1 it
// would look independent.
TEST(Identifiable, GaugeGoesOutBeforeScaling) {
  Eigen::MatrixXd J = RandomColumns(40, 3);
  J.col(1) *= 1e-17;
  const ParameterSet names = Names({Offset("dq1"), Offset("dq2"), Offset("dq3")});
  const IdentifiableSet set = Identifiable(J, names, {});
  EXPECT_EQ(set.active, (std::vector<int>{0, 2}));
  EXPECT_EQ(RelationText(set.redundancies[0], names), "dq2 = no effect");
}

// The threshold of dependence: 1e-9 is rounding of a relation, 1e-5 is a direction.
TEST(Identifiable, DependenceThreshold) {
  Eigen::MatrixXd J = RandomColumns(40, 3);
  const Eigen::VectorXd own = J.col(2);
  IdentifiabilityOptions options;
  options.use_sd_bounds = false;
  const ParameterSet names = Names({Offset("dq1"), Offset("dq2"), Offset("dq3")});
  J.col(2) = J.col(0) + 1e-9 * own;
  EXPECT_EQ(Identifiable(J, names, options).active.size(), 2u);
  J.col(2) = J.col(0) + 1e-5 * own;
  EXPECT_EQ(Identifiable(J, names, options).active.size(), 3u);
}

// A whitened column of norm k means a standard deviation of 1 / k: 30 per m is 33 mm, too weak; 100
// is 10 mm, kept. 20 per rad is 2.9 deg, too weak; 50 is 1.1 deg, kept. Frames are never dropped
// for weakness.
TEST(Identifiable, WeakDirectionsStayNominal) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(10, 5);
  const double norms[] = {30, 100, 20, 50, 1};
  for (int i = 0; i < 5; ++i) J(i, i) = norms[i];
  const ParameterSet names =
      Names({Length("da1"), Length("da2"), Angle("dbeta1"), Angle("dbeta2"), Base("base.x")});
  const IdentifiableSet set = Identifiable(J, names, {});
  EXPECT_EQ(set.active, (std::vector<int>{1, 3, 4}));
  for (const NullRelation& relation : set.redundancies) {
    EXPECT_TRUE(relation.undetermined);
    EXPECT_NE(ReasonText(relation, names).find("too weakly"), std::string::npos);
  }
  IdentifiabilityOptions without;
  without.use_sd_bounds = false;
  EXPECT_EQ(Identifiable(J, names, without).active.size(), 5u);
}

TEST(Identifiable, ConditionOfScaledColumns) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(5, 2);
  J(0, 0) = 1e6;
  J(0, 1) = 600;
  J(1, 1) = 800;  // unit columns (1, 0) and (0.6, 0.8): singular values sqrt(1.6), sqrt(0.4)
  EXPECT_NEAR(Identifiable(J, Names({Offset("dq1"), Offset("dq2")}), {}).condition, 2, 1e-12);
}

// Fewer rows than candidates must not read outside the matrix, and keeps at most as many as there
// are rows.
TEST(Identifiable, FewRows) {
  const IdentifiableSet set = Identifiable(
      RandomColumns(2, 4), Names({Offset("a"), Offset("b"), Offset("c"), Offset("d")}), {});
  EXPECT_EQ(set.active, (std::vector<int>{0, 1}));
  EXPECT_EQ(set.redundancies.size(), 2u);
}

// A relation with a frame names the frame, not six terms.
TEST(RelationText, NamesFrames) {
  Eigen::MatrixXd J = RandomColumns(40, 4);
  J.col(3) = J.col(0) + 3 * J.col(1);
  const ParameterSet names = Names({Base("base.x"), Base("base.y"), Offset("dq2"), Offset("dq1")});
  const IdentifiableSet set = Identifiable(J, names, {});
  ASSERT_EQ(set.redundancies.size(), 1u);
  EXPECT_EQ(RelationText(set.redundancies[0], names), "dq1 = a motion of the base frame");
  EXPECT_NE(ReasonText(set.redundancies[0], names).find("that frame takes it up"),
            std::string::npos);
}

// The partner that stays stands first; a coefficient other than one is no equality of names.
TEST(DroppedText, SaysWhichOfTwoWent) {
  const ParameterSet names = Names({Length("dh2"), Length("dh3"), Base("base.x")});
  const NullRelation alike{1, {{0, 1 - 1e-13}}, false, true};
  EXPECT_EQ(DroppedText(alike, names), "dh2 = dh3: dropped dh3");
  EXPECT_EQ(ReasonText(alike, names), "dh2 = dh3: dropped dh3, at any poses");
  EXPECT_EQ(RelationText(alike, names), "dh3 = +1 dh2");
  EXPECT_EQ(DroppedText({1, {{0, -1}}, false, true}, names), "dh3 = -1 dh2: dropped dh3");
  EXPECT_EQ(DroppedText({1, {{2, 1}}, false, true}, names),
            "dh3 = a motion of the base frame: dropped dh3");
  EXPECT_EQ(DroppedText({1, {}, false, true}, names), "dh3 = no effect: dropped dh3");
}

}  // namespace
}  // namespace truepose
