// The laws of the pose group and of rotation vectors, at identity, tiny, random and near-pi
// arguments. Would catch a wrong order, a missing transpose, a series used outside its range, and a
// logarithm that fails near half a turn.
#include <gtest/gtest.h>

#include "core/geometry/pose.h"
#include "core/measurement/frame.h"
#include "tests/core/testing/robots.h"

namespace truepose {
namespace {

using testing::RandomVector;

std::vector<Pose> Poses() {
  Random random(5);
  std::vector<Pose> poses = {Pose{}};
  for (double angle : {1e-12, 1e-9, 1e-7, 1e-4, 0.3, 2.0, 3.1, 3.14159, 3.14159265}) {
    const Eigen::Vector3d axis = RandomVector(3, 1, &random).normalized();
    poses.push_back({ExpRotation<double>(angle * axis), RandomVector(3, 2, &random)});
  }
  return poses;
}

double Distance(const Pose& a, const Pose& b) { return (a.R - b.R).norm() + (a.p - b.p).norm(); }

TEST(PoseLaws, GroupOfPoses) {
  for (const Pose& A : Poses()) {
    EXPECT_LT(Distance(A * Inverse(A), Pose{}), 1e-14);
    EXPECT_LT(Distance(Inverse(A) * A, Pose{}), 1e-14);
    EXPECT_EQ(Distance(A * Pose{}, A), 0);
    for (const Pose& B : Poses()) {
      const Eigen::Vector3d p(0.3, -0.7, 1.1);
      EXPECT_LT(((A * B) * p - A * (B * p)).norm(), 1e-14);
      EXPECT_LT(Distance(Inverse(A * B), Inverse(B) * Inverse(A)), 1e-14);
      for (const Pose& C : Poses()) EXPECT_LT(Distance((A * B) * C, A * (B * C)), 1e-13);
    }
  }
}

// Exp and Log undo each other; the quaternion is of unit length with w >= 0 and gives the matrix
// back.
TEST(PoseLaws, RotationVectors) {
  for (const Pose& A : Poses()) {
    const Eigen::Vector3d r = LogRotation<double>(A.R);
    EXPECT_LE(r.norm(), M_PI + 1e-12);
    EXPECT_LT((ExpRotation<double>(r) - A.R).norm(), 1e-14) << r.transpose();
    const Eigen::Vector4d q = QuaternionOf<double>(A.R);
    EXPECT_NEAR(q.norm(), 1, 1e-15);
    EXPECT_GE(q(3), 0);
    EXPECT_LT((RotationOf<double>(q) - A.R).norm(), 1e-14);
  }
}

// A rotation by a known angle about a known axis: a sign error in Exp, Log and Hat together would
// pass the law above.
TEST(PoseLaws, ARightHandedQuarterTurn) {
  const Eigen::Matrix3d R = ExpRotation<double>({0, 0, M_PI / 2});
  EXPECT_LT((R * Eigen::Vector3d::UnitX() - Eigen::Vector3d::UnitY()).norm(), 1e-15);
  EXPECT_LT((LogRotation<double>(R) - Eigen::Vector3d(0, 0, M_PI / 2)).norm(), 1e-15);
  EXPECT_EQ(Hat<double>({1, 2, 3}) * Eigen::Vector3d(4, 5, 6),
            Eigen::Vector3d(1, 2, 3).cross(Eigen::Vector3d(4, 5, 6)));
}

// Log(Exp(r) Exp(w)) - r = J_r^-1(r) w for tiny w, also where the coefficient changes to its
// series.
TEST(PoseLaws, RightJacobianInverse) {
  Random random(6);
  for (double size : {0.0, 1e-5, 9.9e-4, 1.01e-3, 0.1, 1.0, 3.0}) {
    const Eigen::Vector3d r = size * RandomVector(3, 1, &random).normalized(),
                          w = 1e-6 * RandomVector(3, 1, &random);
    const auto log = [&](const Eigen::Vector3d& v) {
      return LogRotation<double>(ExpRotation<double>(r) * ExpRotation<double>(v));
    };
    EXPECT_LT(((log(w) - log(-w)) / 2 - RightJacobianInverse(r) * w).norm(), 1e-14) << size;
  }
}

TEST(PoseLaws, NearestRotationOfAReflectionIsARotation) {
  const Eigen::Matrix3d R = NearestRotation(Eigen::Vector3d(1, 2, -3).asDiagonal());
  EXPECT_NEAR(R.determinant(), 1, 1e-14);
  const Eigen::Matrix3d Q = ExpRotation<double>({0.1, 0.2, 0.3});
  EXPECT_LT((NearestRotation(1.7 * Q) - Q).norm(), 1e-14);
}

TEST(PoseLaws, AlignPointsFindsThePose) {
  Random random(7);
  for (const Pose& X_AB : Poses()) {
    Eigen::Matrix3Xd b(3, 5), a(3, 5);
    for (int i = 0; i < 5; ++i) {
      b.col(i) = RandomVector(3, 1, &random);
      a.col(i) = X_AB * Eigen::Vector3d(b.col(i));
    }
    EXPECT_LT(Distance(AlignPoints(a, b), X_AB), 1e-12);
  }
}

// Corrections of a frame: zero changes nothing; positions are along the axes of the frame's base
// and do not turn it; rotations leave its origin where it is.
TEST(PoseLaws, FrameCorrections) {
  for (const Pose& X : Poses()) {
    const double zero[6] = {};
    EXPECT_LT(Distance(Corrected(X, zero, nullptr), X), 1e-15);
    const double shift[6] = {0.1, -0.2, 0.3, 0, 0, 0};
    EXPECT_LT(Distance(Corrected(X, shift, nullptr), {X.R, X.p + Eigen::Vector3d(0.1, -0.2, 0.3)}),
              1e-15);
    const double turn[6] = {0, 0, 0, 0.1, 0, 0};
    EXPECT_LT(Distance(Corrected(X, turn, nullptr), {ExpRotation<double>({0.1, 0, 0}) * X.R, X.p}),
              1e-15);
  }
}

}  // namespace
}  // namespace truepose
