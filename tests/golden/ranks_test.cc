// Numbers of identifiable parameters, Table 3 and Eqs. 11 to 13 in the form of the corrected
// chapter (docs/models.md). Would catch a B_i of the wrong joint type, a joint motion in the wrong
// place, a null space that depends on luck.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "core/identification/identifiability.h"
#include "core/identification/prediction.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::CountedRobot;
using testing::kDeg;
using ::testing::UnorderedElementsAre;

// Identifiable parameters of the complete model (with B_0 and C) at generic poses, full pose
// measured.
IdentifiableSet CompleteSet(const Robot& robot, const Model& model) {
  Random random(31);
  const int poses = 60, n = robot.joint_count();
  Eigen::MatrixXd J(6 * poses, model.parameters.size());
  const Eigen::VectorXd lambda = Eigen::VectorXd::Zero(model.parameters.size());
  Sweep sweep;
  for (int i = 0; i < poses; ++i) {
    const Eigen::VectorXd q = testing::RandomVector(n, 1.5, &random);
    RunSweep(model.chain, q.data(), lambda.data(), &sweep);
    for (Eigen::Index k = 0; k < J.cols(); ++k)
      J.block<6, 1>(6 * i, k) = TwistAt(sweep.X_0E.p, sweep.J_parameters.col(k));
  }
  IdentifiabilityOptions options;
  options.use_sd_bounds = false;
  return Identifiable(J, model.parameters, options);
}

Problem OneReading(const Model& model, ObservationKind kind) {
  Problem problem{&model, {Reading{}}, {""}, {""}};
  problem.readings[0].kind = kind;
  return problem;
}

int Count(const Robot& robot, ObservationKind kind) {
  const Model model = ModifiedIncremental(robot, ModelExtent::kInternal);
  return static_cast<int>(GenericIdentifiable(OneReading(model, kind), robot).active.size());
}

// Eq. 11: N = 4R + 2P + 6 on ten chains, in the complete form and as base + tool + internal.
TEST(Ranks, TenChains) {
  for (const CountedRobot& counted : testing::CountedRobots()) {
    SCOPED_TRACE(counted.name);
    const Model model = ModifiedIncremental(counted.robot, ModelExtent::kComplete);
    EXPECT_EQ(CompleteSet(counted.robot, model).active.size(),
              static_cast<size_t>(counted.parameters));
    EXPECT_EQ(Count(counted.robot, ObservationKind::kPose), counted.parameters);
  }
}

// Eq. 13 holds only where base and tool motions do not overlap: N - rank(external).
TEST(Ranks, InternalParameters) {
  const std::map<std::string, int> internal = {
      {"SCARA RRPR", 9}, {"planar 3R", 7}, {"gantry PPP", 3}, {"single R", 0},
      {"elbow 6R", 18},  {"Stanford", 16}, {"PPPRRR", 12},    {"Panda 7R", 22}};
  for (const CountedRobot& counted : testing::CountedRobots()) {
    const auto expected = internal.find(counted.name);
    if (expected == internal.end()) continue;
    SCOPED_TRACE(counted.name);
    const Model model = ModifiedIncremental(counted.robot, ModelExtent::kInternal);
    const Problem problem = OneReading(model, ObservationKind::kPose);
    const std::vector<int> active = GenericIdentifiable(problem, counted.robot).active;
    const auto first = std::lower_bound(active.begin(), active.end(), problem.FirstInternal());
    EXPECT_EQ(active.end() - first, expected->second);
  }
}

// The chapter's measuring robot: G = 5, 6 and 3. Eq. 12 would say 25, 26 and 23.
TEST(Ranks, MeasuringRobot) {
  EXPECT_EQ(Count(testing::MeasuringArm(), ObservationKind::kPointAxis), 25);
  EXPECT_EQ(Count(testing::MeasuringArm(), ObservationKind::kPose), 26);
  EXPECT_EQ(Count(testing::MeasuringArm(), ObservationKind::kPoint), 23);
}

// Eq. 12 is an upper bound: with points only a target on the last axis shows fewer parameters than
// one beside it.
TEST(Ranks, StanfordByPointsDependsOnTheTarget) {
  EXPECT_EQ(Count(testing::Stanford(), ObservationKind::kPoint), 25);
  const Model model = ModifiedIncremental(testing::Stanford(), ModelExtent::kInternal);
  Problem problem{&model, {}, {""}, {""}};
  Estimate estimate = NominalEstimate(problem);
  estimate.X_FT[0].p.z() = 0.1;
  Random random(32);
  for (int i = 0; i < 80; ++i) {
    Reading reading;
    reading.kind = ObservationKind::kPoint;
    reading.q = testing::RandomVector(6, 1.5, &random);
    reading.X_MT = Predict(problem, reading, estimate);
    problem.readings.push_back(reading);
  }
  IdentifiabilityOptions options;
  options.use_sd_bounds = false;
  EXPECT_EQ(
      Identifiable(Whitened(problem, estimate, {}).J, Candidates(problem), options).active.size(),
      23u);
}

std::vector<std::string> NamesOf(const std::vector<int>& indices, const ParameterSet& set) {
  std::vector<std::string> names;
  for (int index : indices) names.push_back(set[index].name);
  return names;
}

// Table 3, modified incremental: the 28 names of the Stanford arm.
TEST(Table3, StanfordModifiedIncremental) {
  const Robot robot = testing::Stanford();
  const Model model = ModifiedIncremental(robot, ModelExtent::kComplete);
  EXPECT_THAT(NamesOf(CompleteSet(robot, model).active, model.parameters),
              UnorderedElementsAre("dalpha0", "dbeta0", "da0", "db0", "dq1", "dalpha1", "da1",
                                   "db1", "dq2", "dalpha2", "dq3", "dalpha3", "dbeta3", "da3",
                                   "db3", "dq4", "dalpha4", "da4", "dq5", "dalpha5", "da5", "db5",
                                   "dq6", "dalpha6", "dbeta6", "da6", "db6", "dc6"));
}

// Its redundancies: dq1 = dbeta1, dq2 = dbeta2, dq3 = -db4, dq4 = -dbeta4, dq5 = dbeta5, dq6 =
// dgamma6.
TEST(Table3, StanfordRedundancies) {
  const Robot robot = testing::Stanford();
  const Model model = ModifiedIncremental(robot, ModelExtent::kComplete);
  const IdentifiableSet set = CompleteSet(robot, model);
  std::map<std::string, std::string> relations;
  for (const NullRelation& relation : set.redundancies) {
    relations[model.parameters[relation.dropped].name] = RelationText(relation, model.parameters);
  }
  EXPECT_EQ(relations, (std::map<std::string, std::string>{{"dbeta1", "dbeta1 = +1 dq1"},
                                                           {"dbeta2", "dbeta2 = +1 dq2"},
                                                           {"db4", "db4 = -1 dq3"},
                                                           {"dbeta4", "dbeta4 = -1 dq4"},
                                                           {"dbeta5", "dbeta5 = +1 dq5"},
                                                           {"dgamma6", "dgamma6 = +1 dq6"}}));
}

// Table 2: j5 - j9 - l_i j12 = 0, that is dbeta_i = dq_i - l_i db_{i+1} for the links of Fig. 7.
TEST(Table2, RelationWithALength) {
  const double length = 0.4;
  const Robot robot =
      testing::DhRobot({{0, 0, length, 90 * kDeg}, {0, 0, 0.3, -90 * kDeg}, {0, 0, 0.1, 0}}, "RRR");
  const Model model = ModifiedIncremental(robot, ModelExtent::kComplete);
  const IdentifiableSet set = CompleteSet(robot, model);
  const int dbeta1 = *model.parameters.Find("dbeta1");
  const auto relation = std::find_if(set.redundancies.begin(), set.redundancies.end(),
                                     [&](const NullRelation& r) { return r.dropped == dbeta1; });
  ASSERT_NE(relation, set.redundancies.end());
  ASSERT_EQ(relation->kept.size(), 2u);
  std::map<int, double> terms(relation->kept.begin(), relation->kept.end());
  EXPECT_NEAR(terms.at(*model.parameters.Find("dq1")), 1, 1e-9);
  EXPECT_NEAR(terms.at(*model.parameters.Find("db2")), -length, 1e-9);
}

}  // namespace
}  // namespace truepose
