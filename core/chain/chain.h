// A chain is a sequence of elementary transforms R(u, v) or T(u, v), u in {x, y, z}, v = constant +
// joint + parameter. Every nominal robot and every model of the chapter is one; there is no other
// kinematics in Truepose.
//
// One sweep gives the pose X_0E of the chain's end E in its start frame 0 and, exactly, how that
// pose moves with each joint and parameter (Eqs. 26-31): a rotation about the axis u through the
// point p gives the column [p x u; u], a translation along u the column [u; 0]. A column is a twist
// at the *origin of frame 0* (style: twist_B); the velocity of a point at position p is t + u x p
// (TwistAt), which is another quantity and is never stored under this name.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/geometry/pose.h"

namespace truepose {

enum class Motion { kRotation, kTranslation };
enum class Axis { kX = 0, kY = 1, kZ = 2 };

struct ElementaryTransform {
  Motion motion = Motion::kRotation;
  Axis axis = Axis::kZ;
  double constant = 0;  // rad or m
  int joint = -1;       // index into q, -1 for none
  int parameter = -1;   // index into lambda, -1 for none
};

using Chain = std::vector<ElementaryTransform>;

ElementaryTransform Rotation(Axis axis, double angle_rad);
ElementaryTransform Translation(Axis axis, double length_m);

// 1 + the largest index of a joint (parameter) in the chain.
int JointCount(const Chain& chain);
int ParameterCount(const Chain& chain);

// X <- X * element at value v, touching only what changes.
template <typename T>
void Apply(Motion motion, Axis axis, const T& v, PoseT<T>* X) {
  using std::cos;
  using std::sin;
  const int k = static_cast<int>(axis);
  if (motion == Motion::kTranslation) {
    X->p += X->R.col(k) * v;
    return;
  }
  const T c = cos(v), s = sin(v);
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  const Vector3<T> a = X->R.col(i), b = X->R.col(j);
  X->R.col(i) = a * c + b * s;
  X->R.col(j) = b * c - a * s;
}

// The element's v. @param q, lambda may be longer than the chain needs.
template <typename T>
T ValueOf(const ElementaryTransform& element, const T* q, const T* lambda) {
  T v(element.constant);
  if (element.joint >= 0) v += q[element.joint];
  if (element.parameter >= 0) v += lambda[element.parameter];
  return v;
}

// X_0E(q, lambda) alone. @param q JointCount values (rad, m), @param lambda ParameterCount values
// (rad, m).
template <typename T>
PoseT<T> Forward(const Chain& chain, const T* q, const T* lambda) {
  PoseT<T> X;
  for (const ElementaryTransform& element : chain) {
    Apply(element.motion, element.axis, ValueOf(element, q, lambda), &X);
  }
  return X;
}

Pose Forward(const Chain& chain, const Eigen::VectorXd& q, const Eigen::VectorXd& lambda);

// Pose and both Jacobians of one configuration; reused from call to call, one per thread.
struct Sweep {
  Pose X_0E;
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_joints;      // 6 x JointCount
  Eigen::Matrix<double, 6, Eigen::Dynamic> J_parameters;  // 6 x ParameterCount
};

// Fills `sweep`, sizing its matrices at the first use. A joint or parameter that moves several
// elements gets the sum.
void RunSweep(const Chain& chain, const double* q, const double* lambda, Sweep* sweep);

// The column of one element at pose X before it: [p x u; u] or [u; 0].
Eigen::Matrix<double, 6, 1> ScrewOf(const ElementaryTransform& element, const Pose& X);

// Velocity of the point at p and angular velocity, of a twist at the origin: [t + u x p; u].
Eigen::Matrix<double, 6, 1> TwistAt(const Eigen::Vector3d& p,
                                    const Eigen::Matrix<double, 6, 1>& twist_0);

}  // namespace truepose
