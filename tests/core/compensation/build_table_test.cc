// Tables as built, held against exact correction at points that the builder has not seen.
#include "core/compensation/build_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <iostream>

#include "compensation/encode_table.h"
#include "compensation/exact.h"
#include "compensation/lookup.h"
#include "compensation/singularity.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/compensation/table_error.h"
#include "tests/core/compensation/drawn_arm.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using compensation::Arm;
using compensation::Outcome;
using compensation::PoseError;

// +- `half` about `middle`, in every joint.
TableSpec Around(const Eigen::VectorXd& middle, const Eigen::VectorXd& half) {
  TableSpec spec;
  for (int i = 0; i < middle.size(); ++i)
    spec.ranges.push_back({middle(i) - half(i), middle(i) + half(i)});
  return spec;
}

Eigen::VectorXd Values(std::initializer_list<double> values) {
  return Eigen::Map<const Eigen::VectorXd>(values.begin(),
                                           static_cast<Eigen::Index>(values.size()));
}

struct Case {
  std::string name;
  Arm arm;
  TableSpec spec;
  std::vector<int> folded;  // coordinates on which nothing depends
};

void PrintTo(const Case& it, std::ostream* out) { *out << it.name; }

Case Ur10Case() {
  return {"UR10",
          testing::DrawnArm(testing::Ur10(), 1),
          Around(Values({0, -1.2, 1.5, -1.8, -1.5, 0}), Values({3, .6, .6, .8, .6, 3})),
          {0, 5}};
}

Case PandaCase() {
  return {"Panda",
          testing::DrawnArm(testing::Panda(), 2),
          Around(Values({0, -.4, 0, -2, 0, 1.6, .8}), Values({2, .5, .5, .5, .5, .5, 2})),
          {0, 6}};
}

Case StanfordCase() {
  return {"Stanford",
          testing::DrawnArm(testing::Stanford(), 3),
          Around(Values({0, 1.2, .4, 0, 1, 0}), Values({3, .6, .2, 1, .5, 3})),
          {0, 5}};
}

Case ScaraCase() {
  return {"SCARA",
          testing::DrawnArm(testing::Scara(), 4),
          Around(Values({0, 1.2, .1, 0}), Values({2, 1, .1, 3})),
          {0, 3}};
}

Case MeasuringCase() {
  Case measuring = {"measuring robot",
                    testing::DrawnArm(testing::MeasuringArm(), 5),
                    Around(Values({0, .5, -.3, 0, .5}), Values({3, .8, .8, 1.5, 1})),
                    {0, 4}};
  measuring.arm.measuring = true;
  return measuring;
}

BuiltTable MustBuild(const Arm& arm, const TableSpec& spec) {
  auto built = BuildTable(arm, spec, {}, {});
  EXPECT_TRUE(built.ok()) << built.status();
  return built.ok() ? *std::move(built) : BuiltTable();
}

// The worst of fresh random points of the domain; how many were refused goes to `refused`.
PoseError WorstOf(const compensation::TableContent& content, int points, uint64_t seed,
                  int* refused) {
  const compensation::Table table = compensation::MakeTable(content);
  const TableDomain domain = DomainOfTable(table);
  Random random(seed);
  PoseError worst;
  for (int i = 0; i < points; ++i) {
    const JointVector q = domain.axes.ToController(DrawIn(domain, &random));
    const TablePoint point = TableErrorAt(table, content.arm, q.data());
    *refused += point.outcome != Outcome::kOk;
    worst.position_m = std::max(worst.position_m, point.error.position_m);
    worst.rotation_rad = std::max(worst.rotation_rad, point.error.rotation_rad);
  }
  return worst;
}

class OfRobots : public ::testing::TestWithParam<Case> {};

// Would catch a worst error that is stated too low, nodes that do not do what was asked for, and
// coordinates that are folded wrongly or not at all.
TEST_P(OfRobots, FreshPointsStayBelowTheStatedError) {
  const Case& it = GetParam();
  const BuiltTable built = MustBuild(it.arm, it.spec);
  const compensation::TableHeader& header = built.content.header;
  int refused = 0;
  const PoseError worst = WorstOf(built.content, 10000, 99, &refused);
  std::cout << it.name << ": nodes";
  for (int n : built.estimate.nodes) std::cout << " " << n;
  std::cout << ", " << built.estimate.bytes / 1e6 << " MB; worst stated "
            << 1e6 * header.worst.position_m << " um, fresh " << 1e6 * worst.position_m
            << " um; estimated " << 1e6 * header.estimated_worst.position_m << " um; near singular "
            << 100 * header.near_singular_share << " %, refused " << refused << " of 10000\n";
  EXPECT_LE(worst.position_m, header.worst.position_m);
  EXPECT_LE(worst.rotation_rad, header.worst.rotation_rad);
  EXPECT_LE(header.worst.position_m, it.spec.position_tolerance_m);
  EXPECT_LE(header.worst.rotation_rad, it.spec.rotation_tolerance_rad);
  EXPECT_GE(header.verification_points, 10000u);
  EXPECT_LE(header.percentile_95.position_m, header.worst.position_m);
  EXPECT_GT(worst.position_m, 0);
  for (int k = 0; k < it.arm.nominal.joints; ++k) {
    const bool folded = std::count(it.folded.begin(), it.folded.end(), k) > 0;
    EXPECT_EQ(built.content.axis[k].nodes == 1, folded) << k;
  }
}

// Would catch a table that the file cannot hold.
TEST_P(OfRobots, CanBeWritten) {
  const BuiltTable built = MustBuild(GetParam().arm, GetParam().spec);
  const auto bytes = compensation::Encode(built.content);
  EXPECT_EQ(static_cast<int64_t>(bytes.size()), built.estimate.bytes)
      << compensation::Check(built.content).message.data();
}

INSTANTIATE_TEST_SUITE_P(Tables, OfRobots,
                         ::testing::Values(Ur10Case(), PandaCase(), StanfordCase(), ScaraCase(),
                                           MeasuringCase()));

// Would catch anything that depends on time, memory or the number of runs.
TEST(BuildTable, EqualInputsGiveEqualBytes) {
  const Case it = StanfordCase();
  TableLabels labels;
  labels.robot = "robots/stanford";
  const auto first = BuildTable(it.arm, it.spec, labels, {});
  const auto second = BuildTable(it.arm, it.spec, labels, {});
  ASSERT_TRUE(first.ok() && second.ok());
  EXPECT_EQ(compensation::Encode(first->content), compensation::Encode(second->content));
}

// Would catch an estimate that is of another table than the one that is built.
TEST(BuildTable, EstimateIsOfTheTableThatIsBuilt) {
  const Case it = Ur10Case();
  const auto estimate = EstimateTable(it.arm, it.spec);
  ASSERT_TRUE(estimate.ok()) << estimate.status();
  const BuiltTable built = MustBuild(it.arm, it.spec);
  // A further round, with a finer grid, is the exception.
  EXPECT_EQ(estimate->nodes, built.estimate.nodes);
  EXPECT_EQ(estimate->bytes, built.estimate.bytes);
  // To leading order: a quarter covers the terms that are left out, and the stated margin.
  EXPECT_NEAR(built.content.header.worst.position_m / estimate->error.position_m, 1, 0.3);
}

// Would catch a refusal that does not help: with the tolerances that it names, as they are written,
// the table must fit, and what was enough stays.
TEST(BuildTable, TooLargeIsRefusedWithWhatWouldFit) {
  for (const int64_t largest : {20'000, 40'000, 70'000}) {
    for (const double finer : {1.0, 0.01}) {
      Case it = Ur10Case();
      it.spec.largest_bytes = largest;
      it.spec.position_tolerance_m *= finer;
      const auto faults = FaultsOf(EstimateTable(it.arm, it.spec).status());
      ASSERT_EQ(faults.size(), 1u) << largest;
      EXPECT_EQ(faults[0].field, "largest_bytes");
      double mm = 0, deg = 0;
      const size_t at = faults[0].expected.find("tolerances to ");
      ASSERT_NE(at, std::string::npos) << faults[0].expected;
      ASSERT_EQ(std::sscanf(faults[0].expected.c_str() + at, "tolerances to %lf mm and %lf deg",
                            &mm, &deg),
                2);
      it.spec.position_tolerance_m = 1e-3 * mm;
      it.spec.rotation_tolerance_rad = deg * testing::kDeg;
      const auto fits = EstimateTable(it.arm, it.spec);
      EXPECT_TRUE(fits.ok()) << fits.status();
      if (finer < 1) {
        EXPECT_NEAR(deg, 0.005, 1e-4) << "the rotation was not the limit";
      }
    }
  }
}

// The wrist turns through its singularity.
Case WristCase() {
  return {"UR10 through its wrist singularity",
          testing::DrawnArm(testing::Ur10(), 1),
          Around(Values({0, -1.2, 1.5, -1.8, 0, 0}), Values({3, .1, .1, .1, .6, 3})),
          {0, 5}};
}

// Would catch a share that is of the grid: here one cell spans the singularity, so that its middle
// is refused and most of it is not.
TEST(BuildTable, StatesWhatShareOfTheDomainIsRefused) {
  Case it = WristCase();
  it.spec.position_tolerance_m = 1e-2;
  it.spec.rotation_tolerance_rad = 1e-2;
  const BuiltTable built = MustBuild(it.arm, it.spec);
  int refused = 0;
  WorstOf(built.content, 10000, 5, &refused);
  EXPECT_GT(refused, 500);
  EXPECT_LT(refused, 9000);
  // Five standard deviations of a share of 10,000.
  EXPECT_NEAR(built.content.header.near_singular_share, 1e-4 * refused, 0.025);
}

// A table that is to hold at a singularity itself. Would catch a build that ends without saying
// where and what to do.
TEST(BuildTable, NamesATargetThatCantBeCorrected) {
  Case it = WristCase();
  it.spec.smallest_singular_value = 1e-4;
  it.spec.position_tolerance_m = it.spec.rotation_tolerance_rad = 1e-2;
  const auto refused = BuildTable(it.arm, it.spec, {}, {});
  EXPECT_EQ(refused.status().code(), absl::StatusCode::kFailedPrecondition) << refused.status();
  const auto faults = FaultsOf(refused.status());
  ASSERT_EQ(faults.size(), 1u) << refused.status();
  EXPECT_EQ(faults[0].field, "domain");
  EXPECT_THAT(faults[0].found, ::testing::HasSubstr(" deg"));
  EXPECT_THAT(faults[0].expected, ::testing::HasSubstr("smallest_singular_value"));
}

// Would catch accuracy that is stated from the few points that were left: of 20 times as many as
// are asked for, about 1 in 30 is far enough from the singularity.
TEST(BuildTable, RefusesWhatTooFewPointsWereVerifiedFor) {
  Case it = WristCase();
  it.spec.ranges[4] = {-0.1, 0.1};
  const Eigen::VectorXd near_rim = Values({0, -1.2, 1.5, -1.8, 0.097, 0});
  it.spec.smallest_singular_value = compensation::SmallestSingularValue(
      it.arm, near_rim.data(), compensation::CharacteristicLength(it.arm.nominal));
  const auto refused = BuildTable(it.arm, it.spec, {}, {});
  EXPECT_EQ(refused.status().code(), absl::StatusCode::kFailedPrecondition);
  const auto faults = FaultsOf(refused.status());
  ASSERT_EQ(faults.size(), 1u) << refused.status();
  EXPECT_EQ(faults[0].field, "verification_points");
  int corrected = 0, drawn = 0;
  ASSERT_EQ(std::sscanf(faults[0].found.c_str(), "%d of %d drawn", &corrected, &drawn), 2);
  EXPECT_GT(corrected, 0);
  EXPECT_LT(corrected, it.spec.verification_points);
  EXPECT_EQ(drawn, 20 * it.spec.verification_points);
  EXPECT_NE(faults[0].found.find("% are refused near a singularity"), std::string::npos);
}

// Of a box with one orientation the fifth joint hardly turns. Would catch it folded for that, and
// its range widened to where the correction does depend on it.
TEST(BuildTable, FoldsOnlyWhatDoesNotMatterInTheWholeRange) {
  const Arm arm = testing::DrawnArm(testing::Ur10(), 1);
  TableSpec spec;
  spec.position_tolerance_m = 2e-3;
  spec.rotation_tolerance_rad = 8.7e-3;
  spec.box.emplace();
  spec.box->box_B = {Eigen::Vector3d(-0.75, -0.35, 0.1), Eigen::Vector3d(-0.65, -0.25, 0.15)};
  spec.box->reference = Values({0, -1.2, 1.5, -1.87, -1.57, 0});
  const auto plan = PlanTable(arm, spec);
  ASSERT_TRUE(plan.ok()) << plan.status();
  const std::vector<bool> whole = FoldedAxes(arm, plan->domain, plan->units, 77);
  for (size_t k = 0; k < whole.size(); ++k) {
    EXPECT_TRUE(whole[k] || !plan->folded[k]) << k;
  }
  EXPECT_TRUE(plan->folded[0]);
  EXPECT_FALSE(plan->folded[4]);
  EXPECT_LT(plan->domain.range[4].width(), 1) << "not what a folded one is given";
}

// A planar arm's exact correction is refused where height costs radians. Would catch points dropped
// there that the table, of an arm without errors, calls ok: nobody would hear how far off they are.
TEST(TableError, CountsWhatOnlyTheTableCallsOk) {
  const Arm truth = testing::DrawnArm(
      testing::DhRobot({{0, 0, .4, 0}, {0, 0, .4, 0}, {0, 0, .3, 0}}, "RRR"), 1, 3e-3, 3e-3);
  Arm perfect = truth;
  perfect.identified = perfect.nominal;
  const BuiltTable built = MustBuild(perfect, Around(Values({0, 1.2, 1}), Values({1, .5, .5})));
  const compensation::Table table = compensation::MakeTable(built.content);
  const TableDomain domain = DomainOfTable(table);
  Random random(4);
  int refused = 0;
  for (int i = 0; i < 200; ++i) {
    const JointVector q = domain.axes.ToController(DrawIn(domain, &random));
    const bool is_refused =
        compensation::CorrectJoints(truth, q.data(), {}).outcome != Outcome::kOk;
    const TablePoint point = TableErrorAt(table, truth, q.data());
    EXPECT_EQ(point.outcome, Outcome::kOk);
    EXPECT_TRUE(point.error.position_m > 0 || !is_refused);
    refused += is_refused;
  }
  EXPECT_GT(refused, 20);
}

// Would catch work that goes on after nobody wants it, and progress that runs backwards.
TEST(BuildTable, IsCancelledAndReports) {
  const Case it = Ur10Case();
  double last = 0;
  int reports = 0;
  Hooks hooks;
  hooks.on_progress = [&](const Progress& progress) {
    EXPECT_GE(progress.fraction, last);
    EXPECT_LE(progress.fraction, 1);
    last = progress.fraction;
    ++reports;
  };
  hooks.is_cancelled = [&] { return last > 0.6; };
  const auto cancelled = BuildTable(it.arm, it.spec, {}, hooks);
  EXPECT_EQ(cancelled.status().code(), absl::StatusCode::kCancelled);
  EXPECT_GT(reports, 5);
  EXPECT_LT(last, 0.9);
}

// Would catch faults that come one by one, or not at all.
TEST(BuildTable, NamesEveryFaultOfItsSpec) {
  TableSpec spec;
  spec.box.emplace();
  spec.box->reference = Eigen::VectorXd::Zero(5);
  spec.box->cone_rad = 4;
  spec.position_tolerance_m = 0;
  spec.smallest_singular_value = 1e-7;
  spec.verification_points = 10;
  const auto refused = EstimateTable(Ur10Case().arm, spec);
  EXPECT_EQ(refused.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultsOf(refused.status()).size(), 6u) << refused.status();
}

// A sliding joint without limits has no range. Would catch a table of infinite size.
TEST(BuildTable, AsksForTheRangeOfSlidingJoints) {
  const auto refused = EstimateTable(StanfordCase().arm, {});
  const auto faults = FaultsOf(refused.status());
  ASSERT_EQ(faults.size(), 1u) << refused.status();
  EXPECT_EQ(faults[0].field, "joint_ranges.joints[2]");
}

}  // namespace
}  // namespace truepose
