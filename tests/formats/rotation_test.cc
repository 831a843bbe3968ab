#include "formats/rotation.h"

#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "gtest/gtest.h"

namespace truepose::formats {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Plain rotation matrices, so that the quaternion products are checked by other arithmetic.
Matrix AxisRotation(int axis, double angle) {
  Matrix r = {};
  const int j = (axis + 1) % 3, k = (axis + 2) % 3;
  r[axis][axis] = 1;
  r[j][j] = r[k][k] = std::cos(angle);
  r[j][k] = -std::sin(angle);
  r[k][j] = std::sin(angle);
  return r;
}

Matrix Multiply(const Matrix& a, const Matrix& b) {
  Matrix c = {};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

Matrix ToMatrix(const QuaternionArray& q) {
  const auto [x, y, z, w] = q;
  return {{{1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)},
           {2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)},
           {2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)}}};
}

Matrix Expected(const std::string& order, bool intrinsic, const std::array<double, 3>& angles) {
  const bool repeated = order[0] == order[2];
  Matrix r = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int i = 0; i < 3; ++i) {
    const int axis = order[i] - 'x';
    const Matrix factor = AxisRotation(axis, angles[repeated ? i : axis]);
    r = intrinsic ? Multiply(r, factor) : Multiply(factor, r);
  }
  return r;
}

void ExpectNear(const Matrix& a, const Matrix& b, const std::string& name) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) EXPECT_NEAR(a[i][j], b[i][j], 1e-14) << name;
  }
}

// Catches: any of the 24 conventions with a wrong order, side or angle.
TEST(RotationTest, AllConventionsAreProductsOfTheirRotations) {
  const std::array<double, 3> angles = {0.3, -1.1, 2.5};
  int conventions = 0;
  for (const char* order :
       {"xyz", "xzy", "yxz", "yzx", "zxy", "zyx", "xyx", "xzx", "yxy", "yzy", "zxz", "zyz"}) {
    for (const bool intrinsic : {true, false}) {
      const std::string name = std::string(order) + (intrinsic ? "-intrinsic" : "-extrinsic");
      const auto convention = ParseEulerConvention(name);
      ASSERT_TRUE(convention.ok()) << name;
      ExpectNear(ToMatrix(FromEuler(*convention, angles)), Expected(order, intrinsic, angles),
                 name);
      ++conventions;
    }
  }
  EXPECT_EQ(conventions, 24);
}

TEST(RotationTest, RejectsOtherConventions) {
  for (const char* name :
       {"xyz", "XYZ-intrinsic", "xxy-intrinsic", "xyy-extrinsic", "abc-intrinsic", "xyzx-intrinsic",
        "-intrinsic", "xyz-intrinsic-extrinsic", "rpy"}) {
    EXPECT_FALSE(ParseEulerConvention(name).ok()) << name;
  }
}

TEST(RotationTest, AngleBetweenIgnoresTheSignOfAQuaternion) {
  const double half = 0.25;
  const QuaternionArray turned = {0, 0, -std::sin(half), -std::cos(half)};
  EXPECT_NEAR(AngleBetween({0, 0, 0, 1}, turned), 2 * half, 1e-15);
  EXPECT_NEAR(AngleBetween(turned, turned), 0, 1e-15);
}

// Catches: normalising that changes a unit vector each time it's read: writing would not read back
// equal.
TEST(RotationTest, NormalisingTwiceChangesNothing) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> value(-1, 1);
  for (int i = 0; i < 100000; ++i) {
    QuaternionArray q = {value(random), value(random), value(random), value(random)};
    const double length = Length(q) * (1 + 9e-4 * value(random));
    for (double& c : q) c /= length;
    ASSERT_TRUE(NormaliseRounded(q));
    const QuaternionArray once = q;
    ASSERT_NEAR(Length(q), 1, 1e-15);
    ASSERT_TRUE(NormaliseRounded(q));
    ASSERT_EQ(q, once);
  }
}

TEST(RotationTest, ALengthFarFromOneIsNoRounding) {
  for (const double length : {0.0, 0.998, 1.002, 1e200}) {
    QuaternionArray q = {0, length, 0, 0};
    EXPECT_FALSE(NormaliseRounded(q)) << length;
    EXPECT_EQ(q[1], length);
  }
}

}  // namespace
}  // namespace truepose::formats
