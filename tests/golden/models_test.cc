// The four models against the chapter: Eq. 11 on ten chains, Table 3 for the Stanford arm, and the
// external parameters of its last two lines. Would catch a B_i of the wrong size, a D&H form in the
// wrong place, and a preference order that keeps other names than the chapter.
#include "tests/core/testing/models.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "core/identification/identifiability.h"

namespace truepose {
namespace {

using testing::Columns;
using ::testing::ElementsAre;
using testing::ModelOf;
using testing::RankOf;
using testing::SideBySide;
using testing::StackedJacobian;
using ::testing::UnorderedElementsAreArray;

constexpr int kPoses = 60;
constexpr uint64_t kSeed = 31;

IdentifiableSet CompleteSet(const Robot& robot, const Model& model) {
  IdentifiabilityOptions options;
  options.use_sd_bounds = false;
  return Identifiable(StackedJacobian(robot, model, kPoses, kSeed), model.parameters, options);
}

// Eq. 11, N = 4R + 2P + 6, in the complete form and as base + tool + internal.
TEST(ModelRanks, TenChainsInFourModels) {
  for (const testing::CountedRobot& counted : testing::CountedRobots()) {
    for (const std::string& kind : ModelKinds()) {
      SCOPED_TRACE(counted.name + ", " + kind);
      const Model complete = ModelOf(kind, counted.robot, ModelExtent::kComplete);
      EXPECT_EQ(CompleteSet(counted.robot, complete).active.size(),
                static_cast<size_t>(counted.parameters));
      const auto internal = BuildModel(kind, counted.robot, ModelExtent::kInternal);
      if (!internal.ok()) continue;
      Problem problem{&*internal, {Reading{}}, {""}, {""}};
      problem.readings[0].kind = ObservationKind::kPose;
      EXPECT_EQ(GenericIdentifiable(problem, counted.robot).active.size(),
                static_cast<size_t>(counted.parameters));
    }
  }
}

// All four span the same motions of the flange, on every chain.
TEST(ModelRanks, OneColumnSpace) {
  for (const testing::NamedRobot& named : testing::AllRobots()) {
    const Model reference = ModelOf("modified_incremental", named.robot, ModelExtent::kComplete);
    const Eigen::MatrixXd J = StackedJacobian(named.robot, reference, kPoses, kSeed);
    for (const std::string& kind : ModelKinds()) {
      SCOPED_TRACE(named.name + ", " + kind);
      const Model model = ModelOf(kind, named.robot, ModelExtent::kComplete);
      const Eigen::MatrixXd own = StackedJacobian(named.robot, model, kPoses, kSeed);
      EXPECT_EQ(RankOf(own), RankOf(J));
      EXPECT_EQ(RankOf(SideBySide(J, own)), RankOf(J));
    }
  }
}

// A column of Table 3: the 28 kept names and the two lines of external ones.
struct Table3Column {
  std::string model;
  std::vector<std::string> names, base, gripper;
};

std::vector<Table3Column> Table3() {
  return {{"extended_dh",
           {"dtheta0", "dl0",   "dphi0", "dbeta0", "dq1",     "dh1", "dl1", "dphi1", "dq2", "dh2",
            "dl2",     "dphi2", "dq3",   "dphi3",  "dbeta3",  "dq4", "dl4", "dphi4", "dq5", "dh5",
            "dl5",     "dphi5", "dq6",   "dbeta6", "dalpha6", "dc6", "db6", "da6"},
           {"dtheta0", "dl0", "dphi0", "dbeta0", "dh1", "dq1"},
           {"dq6", "dbeta6", "dalpha6", "dc6", "db6", "da6"}},
          {"incremental",
           {"dalpha0", "dbeta0",  "da0",    "db0",     "dalpha1", "dbeta1", "da1",
            "db1",     "dalpha2", "dbeta2", "dalpha3", "dbeta3",  "da3",    "db3",
            "dalpha4", "dbeta4",  "da4",    "db4",     "dalpha5", "dbeta5", "da5",
            "db5",     "dgamma6", "dbeta6", "dalpha6", "dc6",     "db6",    "da6"},
           {"dalpha0", "dbeta0", "da0", "db0", "db1", "dbeta1"},
           {"dgamma6", "dbeta6", "dalpha6", "dc6", "db6", "da6"}},
          {"modified_incremental",
           {"dalpha0", "dbeta0", "da0",     "db0",     "dq1",     "dalpha1", "da1",
            "db1",     "dq2",    "dalpha2", "dq3",     "dalpha3", "dbeta3",  "da3",
            "db3",     "dq4",    "dalpha4", "da4",     "dq5",     "dalpha5", "da5",
            "db5",     "dq6",    "dbeta6",  "dalpha6", "dc6",     "db6",     "da6"},
           {"dalpha0", "dbeta0", "da0", "db0", "db1", "dq1"},
           {"dq6", "dbeta6", "dalpha6", "dc6", "db6", "da6"}},
          {"zhuang_roth",
           {"dthetax0", "dthetay0", "da0",      "db0",      "dthetax1", "dthetay1", "da1",
            "db1",      "dthetax2", "dthetay2", "dthetax3", "dthetay3", "da3",      "db3",
            "dthetax4", "dthetay4", "da4",      "db4",      "dthetax5", "dthetay5", "da5",
            "db5",      "dgamma6",  "dbeta6",   "dalpha6",  "dc6",      "db6",      "da6"},
           {"dthetax0", "dthetay0", "da0", "db0", "db1", "dthetax1"},
           {"dgamma6", "dbeta6", "dalpha6", "dc6", "db6", "da6"}}};
}

TEST(ModelTable3, KeptNames) {
  const Robot robot = testing::StanfordBesideBase();
  for (const Table3Column& column : Table3()) {
    SCOPED_TRACE(column.model);
    const Model model = ModelOf(column.model, robot, ModelExtent::kComplete);
    std::vector<std::string> kept;
    for (int index : CompleteSet(robot, model).active) kept.push_back(model.parameters[index].name);
    EXPECT_EQ(kept.size(), 28u);
    EXPECT_THAT(kept, UnorderedElementsAreArray(column.names));
  }
}

// h_2 = h_3 and l_3 = h_4, where l_3 is the joint coordinate; nothing else is redundant.
TEST(ModelTable3, RedundanciesOfExtendedDh) {
  const Robot robot = testing::StanfordBesideBase();
  const Model model = ModelOf("extended_dh", robot, ModelExtent::kComplete);
  const Eigen::MatrixXd J = StackedJacobian(robot, model, kPoses, kSeed);
  std::map<std::string, std::pair<std::string, double>> partner;
  for (const NullRelation& relation : CompleteSet(robot, model).redundancies) {
    ASSERT_EQ(relation.kept.size(), 1u) << RelationText(relation, model.parameters);
    partner[model.parameters[relation.dropped].name] = {
        model.parameters[relation.kept[0].first].name, relation.kept[0].second};
    EXPECT_LT((J.col(relation.dropped) - relation.kept[0].second * J.col(relation.kept[0].first))
                  .cwiseAbs()
                  .maxCoeff(),
              1e-12);
  }
  ASSERT_EQ(partner.size(), 2u);
  EXPECT_EQ(partner["dh3"].first, "dh2");
  EXPECT_EQ(partner["dh4"].first, "dq3");
  EXPECT_NEAR(partner["dh3"].second, 1, 1e-9);
  EXPECT_NEAR(partner["dh4"].second, 1, 1e-9);
}

// The lines of external parameters span exactly the six motions of the base and of the tool; 16 are
// internal.
TEST(ModelTable3, ExternalParameters) {
  const Robot robot = testing::StanfordBesideBase();
  const Eigen::MatrixXd base = testing::StackedBaseMotions(robot, kPoses, kSeed),
                        tool = testing::StackedToolMotions(robot, kPoses, kSeed);
  for (const Table3Column& column : Table3()) {
    SCOPED_TRACE(column.model);
    const Model model = ModelOf(column.model, robot, ModelExtent::kComplete);
    const Eigen::MatrixXd J = StackedJacobian(robot, model, kPoses, kSeed);
    const Eigen::MatrixXd of_base = Columns(J, model, column.base),
                          of_gripper = Columns(J, model, column.gripper);
    EXPECT_EQ(RankOf(of_base), 6);
    EXPECT_EQ(RankOf(SideBySide(of_base, base)), 6);
    EXPECT_EQ(RankOf(of_gripper), 6);
    EXPECT_EQ(RankOf(SideBySide(of_gripper, tool)), 6);
    EXPECT_EQ(RankOf(J) - RankOf(SideBySide(base, tool)), 16);
  }
}

// With d0 = 0 Hayati's base would have rank 27 (chapter-notes 6); the form of Eq. 33 has 28.
TEST(ModelTable3, StanfordOverItsBase) {
  const Robot robot = testing::Stanford();
  const Model model = ModelOf("extended_dh", robot, ModelExtent::kComplete);
  EXPECT_EQ(RankOf(StackedJacobian(robot, model, kPoses, kSeed)), 28);
  EXPECT_FALSE(model.parameters.Find("dl0").has_value());
}

}  // namespace
}  // namespace truepose
