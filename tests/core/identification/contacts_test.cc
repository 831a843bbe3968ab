// A ball in sockets whose places are known: which motions of the base the sockets leave free.
#include "core/identification/contacts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "core/identification/identify.h"
#include "core/identification/prediction.h"
#include "core/models/build_model.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

// A robot with errors of 0.5 mm and 0.5 mrad that touches sockets in front of it, and the frames
// that are true of it.
class AtSockets : public ::testing::Test {
 protected:
  AtSockets()
      : robot_(testing::Ur10()),
        model_(*BuildModel("modified_incremental", robot_, ModelExtent::kInternal)) {
    problem_.model = &model_;
    problem_.placements = problem_.targets = {""};
    truth_ = NominalEstimate(problem_);
    truth_.lambda = testing::RandomVector(model_.parameters.size(), 5e-4, &random_);
    truth_.X_FT[0] = {Eigen::Matrix3d::Identity(), {0.03, -0.02, 0.12}};
    middle_ << 0.2, -1.2, 1.6, -1.9, -1.5, 0.3;
    truth_.X_MB[0].R = ExpRotation<double>(Eigen::Vector3d(0.3, -0.5, 0.8));
    truth_.X_MB[0].p =
        -(truth_.X_MB[0].R * (Forward(model_, middle_, truth_.lambda) * truth_.X_FT[0]).p);
  }

  // 40 contacts with each socket, the socket places as they are in M; joints near the middle.
  void Touch(const std::vector<Eigen::Vector3d>& sockets) {
    for (const Eigen::Vector3d& socket : sockets) {
      for (int i = 0; i < 40; ++i) problem_.readings.push_back(Contact(socket));
    }
  }

  Reading Contact(const Eigen::Vector3d& socket) {
    Problem one = problem_;
    Reading reading;
    reading.kind = ObservationKind::kPoint;
    reading.contact = true;
    reading.X_MT.p = socket;
    do {
      reading.q = middle_ + testing::RandomVector(6, 0.4, &random_);
      one.readings = {reading};
      one = AtContacts(one, truth_);
    } while (!Touches(one.readings[0], truth_));
    return one.readings[0];
  }

  bool Touches(const Reading& reading, const Estimate& estimate) const {
    return ResidualAt(problem_, reading, estimate).norm() < 1e-11;
  }

  // Active corrections of the base after a fit of the nominal robot's frames, and again with its
  // parameters.
  std::pair<int, int> BaseRanks() {
    Estimate nominal = truth_;
    nominal.lambda.setZero();
    const auto before = FitFrames(problem_, nominal, {}, {});
    EXPECT_TRUE(before.ok()) << before.status();
    const auto after = Identify(problem_, GenericIdentifiable(problem_, robot_), *before, {}, {});
    EXPECT_TRUE(after.ok()) << after.status();
    if (!before.ok() || !after.ok()) return {-1, -1};
    set_ = after->set;
    return {BasesIn(before->set), BasesIn(after->set)};
  }

  static int BasesIn(const IdentifiableSet& set) {
    return static_cast<int>(std::count_if(set.active.begin(), set.active.end(),
                                          [](int i) { return i < kFrameParameters; }));
  }

  Random random_{41};
  Robot robot_;
  Model model_;
  Problem problem_;
  Estimate truth_;
  Eigen::VectorXd middle_ = Eigen::VectorXd::Zero(6);
  IdentifiableSet set_;
};

// Catches a rank that is judged where a nominal robot predicts its contacts, millimetres off the
// line: 6 in place of 5. The line is askew in M, so the turn is no single correction.
TEST_F(AtSockets, TwoLeaveTheTurnAboutTheirLine) {
  Touch({{0, 0, 0}, {0.03, 0.04, 0}});
  EXPECT_EQ(BaseRanks(), std::make_pair(5, 5));
  ASSERT_FALSE(set_.redundancies.empty());
  EXPECT_EQ(ReasonText(set_.redundancies[0], Candidates(problem_)),
            "turn of base about the line of its sockets, along (0.6, 0.8, 0): not observable at "
            "any poses; base.ry stays where it started");
}

// Three on a line show no more than two, and a fourth beside the line shows all.
TEST_F(AtSockets, OneBesideTheLineShowsAll) {
  Touch({{0, 0, 0}, {0.05, 0, 0}, {0.1, 0, 0}});
  EXPECT_EQ(BaseRanks(), std::make_pair(5, 5));
  Touch({{0, 0.05, 0}});
  EXPECT_EQ(BaseRanks(), std::make_pair(6, 6));
}

TEST_F(AtSockets, OneLeavesAllTurns) {
  Touch({{0, 0, 0}});
  EXPECT_EQ(BaseRanks(), std::make_pair(3, 3));
}

// Readings of an instrument keep their joints: their places are measured, not given.
TEST_F(AtSockets, OnlyContactsMove) {
  Touch({{0, 0, 0}});
  problem_.readings[1].contact = false;
  Estimate nominal = truth_;
  nominal.lambda.setZero();
  const Problem moved = AtContacts(problem_, nominal);
  EXPECT_TRUE(Touches(moved.readings[0], nominal));
  EXPECT_FALSE(Touches(problem_.readings[0], nominal));
  EXPECT_EQ(moved.readings[1].q, problem_.readings[1].q);
}

// Out of reach: the joints stay as read, and nothing is divided by zero.
TEST_F(AtSockets, OutOfReachStays) {
  Touch({{0, 0, 0}});
  problem_.readings[0].X_MT.p << 10, 0, 0;
  EXPECT_EQ(AtContacts(problem_, truth_).readings[0].q, problem_.readings[0].q);
}

}  // namespace
}  // namespace truepose
