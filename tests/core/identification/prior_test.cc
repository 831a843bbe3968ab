#include "core/identification/prior.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/models/model.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using ::testing::HasSubstr;

StoredCalibration Stored() {
  StoredCalibration stored;
  stored.internal = {{"dq2", 1e-3}, {"da2", -5e-4}, {"dq3", 0.0}};
  stored.identified = {"dq2", "da2"};
  stored.covariance.resize(2, 2);
  stored.covariance << 4e-10, 3e-10, 3e-10, 9e-10;
  return stored;
}

// root C root' = 1 for the stored covariance, in the order of the model's parameters.
TEST(Prior, RootWhitensTheStoredCovariance) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  const auto prior = PriorOf(Stored(), model.parameters);
  ASSERT_TRUE(prior.ok()) << prior.status();
  const Eigen::MatrixXd C = InternalCovariance(Stored(), model.parameters);
  EXPECT_LT((prior->root * C * prior->root.transpose() - Eigen::Matrix2d::Identity()).norm(),
            1e-12);
  EXPECT_EQ(prior->mean(*model.parameters.Find("dq2")), 1e-3);
  EXPECT_EQ(prior->root.col(*model.parameters.Find("dq3")).norm(), 0) << "nothing is known of dq3";
}

TEST(Prior, ToleranceByUnit) {
  Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  AddEffects(testing::Ur10(), EffectGroup::kGain, &model);
  Prior prior = PriorOf(TolerancePrior{}, model.parameters);
  EXPECT_EQ(prior.root.rows(), model.parameters.size() - 6) << "none for effects";
  EXPECT_NEAR(prior.root.col(*model.parameters.Find("da2")).norm(), 1 / 3e-4, 1e-9);
  EXPECT_NEAR(prior.root.col(*model.parameters.Find("dq2")).norm(), 180 / (0.03 * M_PI), 1e-6);
  AddEffectPrior(model.parameters, &prior);
  EXPECT_NEAR(prior.root.col(*model.parameters.Find("gain2")).norm(), 2000, 1e-9);
}

TEST(Prior, FaultsOfACovariance) {
  const Model model = ModifiedIncremental(testing::Ur10(), ModelExtent::kInternal);
  const auto fault = [&](const StoredCalibration& stored) {
    const auto prior = PriorOf(stored, model.parameters);
    return prior.ok() ? std::string("ok") : std::string(prior.status().message());
  };
  StoredCalibration stored = Stored();
  stored.covariance(0, 1) = stored.covariance(1, 0) = 7e-10;
  EXPECT_THAT(fault(stored), HasSubstr("not positive definite"));
  stored = Stored();
  stored.covariance(0, 1) = 0;
  EXPECT_THAT(fault(stored), HasSubstr("not symmetric"));
  stored = Stored();
  stored.covariance(1, 1) = -1;
  EXPECT_THAT(fault(stored), HasSubstr("not positive"));
  stored = Stored();
  stored.covariance(1, 1) = std::nan("");
  EXPECT_THAT(fault(stored), HasSubstr("not finite"));
  stored = Stored();
  stored.covariance.resize(3, 3);
  EXPECT_THAT(fault(stored), HasSubstr("3 x 3"));
  stored = Stored();
  stored.internal.emplace_back("dphi7", 1e-3);
  EXPECT_THAT(fault(stored), HasSubstr("dphi7"));
}

}  // namespace
}  // namespace truepose
