// Would catch a formula with R and P exchanged, effects counted as geometry, and a number of
// internal parameters taken from Eq. 13 where base and tool overlap.
#include "core/conversion/counts.h"

#include <gtest/gtest.h>

#include <map>

#include "core/conversion/describe.h"
#include "tests/core/testing/models.h"

namespace truepose {
namespace {

TEST(Counts, FormulasAndRanks) {
  struct Row {
    int by_formula, internal;
  };
  const std::map<std::string, Row> rows = {{"elbow 6R", {18, 18}}, {"Stanford", {16, 16}},
                                           {"SCARA RRPR", {8, 9}}, {"SCARA RRRP", {8, 9}},
                                           {"gantry PPP", {0, 3}}, {"PPPRRR", {12, 12}},
                                           {"single R", {-2, 0}},  {"planar 3R", {6, 7}},
                                           {"Panda 7R", {22, 22}}, {"RPPRR", {10, 10}}};
  for (const testing::CountedRobot& counted : testing::CountedRobots()) {
    for (const std::string& kind : ModelKinds()) {
      const auto description = DescribeModel(kind, counted.robot);
      if (!description.ok()) continue;
      SCOPED_TRACE(counted.name + ", " + kind);
      const ParameterCounts& counts = description->counts;
      EXPECT_EQ(counts.complete_by_formula, counted.parameters);
      EXPECT_EQ(counts.measured_by_formula, counted.parameters);
      EXPECT_EQ(counts.rank, counted.parameters);
      EXPECT_EQ(counts.internal_by_formula, rows.at(counted.name).by_formula);
      EXPECT_EQ(counts.internal(), rows.at(counted.name).internal);
    }
  }
}

// G = 3, 5; and effects are none of the 4R + 2P + G.
TEST(Counts, MeasuredCoordinatesAndEffects) {
  const Robot robot = testing::MeasuringArm();
  Model model = testing::ModelOf("modified_incremental", robot, ModelExtent::kInternal);
  AddEffects(robot, EffectGroup::kHarmonic1, &model);
  Problem problem{&model, {Reading{}}, {""}, {""}};
  for (const auto& [kind, rank] :
       {std::pair{ObservationKind::kPoint, 23}, std::pair{ObservationKind::kPointAxis, 25}}) {
    problem.readings[0].kind = kind;
    const IdentifiableSet generic = GenericIdentifiable(problem, robot);
    const ParameterCounts counts = CountParameters(robot, problem, generic);
    EXPECT_EQ(counts.measured_by_formula, rank);
    EXPECT_EQ(counts.rank, rank);
    EXPECT_GT(generic.active.size(), static_cast<size_t>(rank));
  }
}

// A description is of the candidates that a calibration has, each kept or explained.
TEST(Describe, EveryCandidateIsKeptOrExplained) {
  for (const std::string& kind : ModelKinds()) {
    SCOPED_TRACE(kind);
    const auto description = DescribeModel(kind, testing::Stanford());
    ASSERT_TRUE(description.ok()) << description.status();
    EXPECT_EQ(description->model.kind, kind);
    EXPECT_EQ(description->candidates[0].name, "base.x");
    EXPECT_EQ(description->candidates.size(), 12 + description->model.parameters.size());
    EXPECT_EQ(static_cast<int>(description->generic.active.size() +
                               description->generic.redundancies.size()),
              description->candidates.size());
    for (const NullRelation& relation : description->generic.redundancies)
      EXPECT_TRUE(relation.structural && !relation.kept.empty());
  }
  EXPECT_FALSE(DescribeModel("dh", testing::Stanford()).ok());
}

// The issue's sentence.
TEST(Describe, StanfordSentences) {
  const auto description = DescribeModel("extended_dh", testing::Stanford());
  ASSERT_TRUE(description.ok()) << description.status();
  std::vector<std::string> sentences;
  for (const NullRelation& relation : description->generic.redundancies)
    sentences.push_back(DroppedText(relation, description->candidates));
  EXPECT_EQ(sentences,
            (std::vector<std::string>{"dq1 = a motion of the base frame: dropped dq1",
                                      "dq6 = a motion of the tool frame: dropped dq6",
                                      "dh1 = a motion of the base frame: dropped dh1",
                                      "dh2 = dh3: dropped dh3", "dq3 = dh4: dropped dh4"}));
}

TEST(Describe, LinkOfAName) {
  EXPECT_EQ(LinkOf("dalpha3"), 3);
  EXPECT_EQ(LinkOf("dq12"), 12);
  EXPECT_EQ(LinkOf("harmonic1_cos4"), 4);
  EXPECT_EQ(LinkOf("base.rx"), std::nullopt);
  EXPECT_EQ(LinkOf("offset[7]"), std::nullopt);
}

}  // namespace
}  // namespace truepose
