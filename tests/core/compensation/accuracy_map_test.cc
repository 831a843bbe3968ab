// The predicted accuracy over a volume.
#include "core/compensation/accuracy_map.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "compensation/kinematics.h"
#include "core/base/fault.h"
#include "core/compensation/arm_from.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

class AccuracyMapTest : public ::testing::Test {
 protected:
  AccuracyMapTest()
      : arm_(*ArmFrom(robot_, model_, Eigen::VectorXd::Zero(model_.parameters.size()))) {
    sources_.model = &model_;
    sources_.lambda = Eigen::VectorXd::Zero(model_.parameters.size());
    sources_.active = {*model_.parameters.Find("dq2")};
    sources_.covariance = Eigen::MatrixXd::Constant(1, 1, 1e-8);  // 0.1 mrad
    sources_.unexplained_m = 1e-4;
    spec_.box.box_B = {Eigen::Vector3d(.4, -.4, .1), Eigen::Vector3d(1.6, .4, .6)};
    spec_.box.reference = (Eigen::VectorXd(6) << 3.3, -1.2, 1.8, -2.2, -1.57, 0).finished();
    spec_.points = {7, 5, 2};
  }

  const Robot robot_ = testing::Ur10();
  const Model model_ = ModifiedIncremental(robot_, ModelExtent::kInternal);
  const compensation::Arm arm_;
  AccuracySources sources_;
  AccuracyMapSpec spec_;
};

// Would catch points in another order, a tool that is not where the point says, and accuracies of
// other joints than those reported.
TEST_F(AccuracyMapTest, IsTheAccuracyAtItsPoints) {
  spec_.box.X_FT.p = Eigen::Vector3d(0, 0, 0.15);
  const auto map = MapAccuracy(arm_, sources_, spec_, {});
  ASSERT_TRUE(map.ok()) << map.status();
  ASSERT_EQ(map->points.size(), 70u);
  EXPECT_TRUE(map->points[1].p_BT.isApprox(Eigen::Vector3d(.6, -.4, .1)));
  EXPECT_TRUE(map->points[7].p_BT.isApprox(Eigen::Vector3d(.4, -.2, .1)));
  EXPECT_TRUE(map->points[35].p_BT.isApprox(Eigen::Vector3d(.4, -.4, .6)));
  for (const AccuracyPoint& point : map->points) {
    if (!point.reached) continue;
    const Pose X_BT = compensation::NominalFlange(arm_, point.q.data()) * spec_.box.X_FT;
    EXPECT_LT((X_BT.p - point.p_BT).norm(), 2e-6);
    EXPECT_LT((X_BT.R.col(2) + Eigen::Vector3d::UnitZ()).norm(), 2e-6);
    // dq2 turns the arm about the shoulder, a horizontal axis at a height of 127.3 mm, square to
    // the plane of the arm.
    const double across = point.q(0);
    const Eigen::Vector3d axis(std::sin(across), -std::cos(across), 0);
    const double lever = axis.cross(X_BT.p - Eigen::Vector3d(0, 0, .1273)).norm();
    EXPECT_NEAR(point.accuracy.parameters_m, 1e-4 * lever, 1e-9);
  }
}

// The far end of the box is out of reach. Would catch that it is left out of the map, or counted in
// its figures.
TEST_F(AccuracyMapTest, SaysWhatIsNotReached) {
  const auto map = MapAccuracy(arm_, sources_, spec_, {});
  ASSERT_TRUE(map.ok()) << map.status();
  EXPECT_FALSE(map->points[6].reached);
  EXPECT_TRUE(map->points[0].reached);
  const auto reached = std::count_if(map->points.begin(), map->points.end(),
                                     [](const AccuracyPoint& point) { return point.reached; });
  EXPECT_EQ(map->reached, reached);
  EXPECT_LT(map->points[map->best].accuracy.position_95_m, map->position_95_m);
  EXPECT_GT(map->points[map->worst].accuracy.position_95_m, map->position_95_m);
  spec_.box.box_B.min().x() = 1.55;
  EXPECT_EQ(MapAccuracy(arm_, sources_, spec_, {}).status().code(),
            absl::StatusCode::kFailedPrecondition);
}

// Would catch a grid of any size.
TEST_F(AccuracyMapTest, NamesFaultsOfItsSpec) {
  spec_.points = {0, 5, 2};
  spec_.box.reference.resize(4);
  const auto refused = MapAccuracy(arm_, sources_, spec_, {});
  EXPECT_EQ(FaultsOf(refused.status()).size(), 2u) << refused.status();
}

}  // namespace
}  // namespace truepose
