#include "tests/compensation/table_samples.h"

#include <Eigen/Dense>
#include <numbers>

#include "core/base/random.h"

namespace truepose::compensation::testing {
namespace {

constexpr double kPi = std::numbers::pi;

Pose About(const Eigen::Vector3d& axis, double angle) {
  return {Eigen::AngleAxisd(angle, axis).toRotationMatrix(), Eigen::Vector3d::Zero()};
}

// T(z, d) T(x, a) R(x, alpha)
Pose Link(double d, double a, double alpha) {
  Pose X = About(Eigen::Vector3d::UnitX(), alpha);
  X.p = {a, 0, d};
  return X;
}

JointChain Ur10Chain() {
  JointChain chain;
  chain.joints = 6;
  chain.constant[1] = Link(0.1273, 0, kPi / 2);
  chain.constant[2] = Link(0, -0.612, 0);
  chain.constant[3] = Link(0, -0.5723, 0);
  chain.constant[4] = Link(0.163941, 0, kPi / 2);
  chain.constant[5] = Link(0.1157, 0, -kPi / 2);
  chain.constant[6] = Link(0.0922, 0, 0);
  return chain;
}

Pose NearIdentity(double error, Random* random) {
  Eigen::Vector3d t, r;
  for (int i = 0; i < 3; ++i) {
    t(i) = random->Uniform(-error, error);
    r(i) = random->Uniform(-error, error);
  }
  return {ExpRotation<double>(r), t};
}

// Up to before the motion of the last joint.
Pose BeforeLast(const JointChain& chain, const double* q) {
  Pose X = chain.constant[0];
  for (int i = 0; i + 1 < chain.joints; ++i) {
    Pose Z = About(Eigen::Vector3d::UnitZ(), chain.prismatic[i] ? 0 : q[i]);
    if (chain.prismatic[i]) Z.p.z() = q[i];
    X = X * Z * chain.constant[i + 1];
  }
  return X;
}

Pose FlangeAt(const JointChain& chain, const double* q) {
  const int last = chain.joints - 1;
  Pose Z = About(Eigen::Vector3d::UnitZ(), chain.prismatic[last] ? 0 : q[last]);
  if (chain.prismatic[last]) Z.p.z() = q[last];
  return BeforeLast(chain, q) * Z * chain.constant[last + 1];
}

void SetRange(double lower, double upper, double margin, int nodes, TableAxis* axis) {
  axis->lower = lower;
  axis->upper = upper;
  axis->margin = margin;
  axis->nodes = nodes;
}

double NodeAt(const TableAxis& axis, int node) {
  if (axis.nodes == 1) return (axis.lower + axis.upper) / 2;
  return axis.lower - axis.margin +
         node * (axis.upper - axis.lower + 2 * axis.margin) / (axis.nodes - 1);
}

}  // namespace

Arm Ur10Arm(double error) {
  Random random(5);
  Arm arm;
  arm.nominal = arm.identified = Ur10Chain();
  for (int i = 1; i < 6; ++i)
    arm.identified.constant[i] = arm.nominal.constant[i] * NearIdentity(error, &random);
  for (int i = 0; i < 6; ++i) arm.limits[i] = {-2 * kPi, 2 * kPi};
  return arm;
}

Eigen::Matrix<double, 6, 1> DeltaByDefinition(const Arm& arm, const double* q_chain) {
  const Pose X_BL = BeforeLast(arm.nominal, q_chain);
  const Pose E = Inverse(X_BL) * FlangeAt(arm.identified, q_chain) *
                 Inverse(FlangeAt(arm.nominal, q_chain)) * X_BL;
  Eigen::Matrix<double, 6, 1> delta;
  delta << E.p, LogRotation<double>(E.R);
  return delta;
}

TableContent Ur10Content(const Arm& arm, const std::array<int, 4>& nodes) {
  TableContent content;
  content.arm = arm;
  content.header.robot = "robots/ur10";
  content.header.serial = "2016300123";
  content.header.calibration = "robots/ur10/calibrations/7";
  for (int i = 0; i < 32; ++i) {
    content.header.calibration_digest[i] = static_cast<std::uint8_t>(i + 1);
    content.header.nominal_digest[i] = static_cast<std::uint8_t>(200 - i);
  }
  content.header.created_us = 1700000000000000;
  content.header.joints = 6;
  content.header.tolerance = {2e-5, 8.7e-5};
  content.header.smallest_singular_value = 0.02;
  content.header.characteristic_length_m = 0.6;
  for (int i = 0; i < 6; ++i) content.axis[i].weight[i] = 1;
  content.axis[3].weight[1] = content.axis[3].weight[2] = 1;
  SetRange(-2 * kPi, 2 * kPi, 0, 1, &content.axis[0]);
  SetRange(-2.4, -0.6, 0.05, nodes[0], &content.axis[1]);
  SetRange(0.4, 2.4, 0.05, nodes[1], &content.axis[2]);
  SetRange(-2.0, -1.2, 0.05, nodes[2], &content.axis[3]);
  SetRange(-2.0, -1.0, 0.05, nodes[3], &content.axis[4]);
  SetRange(-2 * kPi, 2 * kPi, 0, 1, &content.axis[5]);
  return content;
}

Arm RandomArm(const std::vector<bool>& prismatic, double error, std::uint64_t seed) {
  Random random(seed);
  Arm arm;
  arm.nominal.joints = static_cast<int>(prismatic.size());
  for (int i = 0; i <= arm.nominal.joints; ++i) {
    arm.nominal.constant[i] = NearIdentity(0.4, &random);
    arm.nominal.constant[i].R =
        ExpRotation<double>(Eigen::Vector3d(random.Normal(), random.Normal(), random.Normal()));
  }
  std::copy(prismatic.begin(), prismatic.end(), arm.nominal.prismatic.begin());
  arm.identified = arm.nominal;
  for (int i = 1; i < arm.nominal.joints; ++i)
    arm.identified.constant[i] = arm.nominal.constant[i] * NearIdentity(error, &random);
  return arm;
}

TableContent PlainContent(const Arm& arm, double range) {
  TableContent content;
  content.arm = arm;
  content.header.joints = arm.nominal.joints;
  content.header.characteristic_length_m = 0.5;
  content.header.smallest_singular_value = 0.05;
  for (int i = 0; i < arm.nominal.joints; ++i) {
    content.axis[i].weight[i] = 1;
    SetRange(-range, range, range / 2, 3, &content.axis[i]);
  }
  FillNodes(&content);
  return content;
}

Pose FlangeByTable(const Table& table, const double* q_chain) {
  const JointChain& chain = table.arm.nominal;
  const Pose X_BL = BeforeLast(chain, q_chain);
  const auto delta = LookUp(table, q_chain, Reach::kGrid).delta;
  const Eigen::Vector3d r = delta.tail<3>();
  const Pose E{ExpRotation<double>(r), delta.head<3>()};
  return X_BL * E * Inverse(X_BL) * FlangeAt(chain, q_chain);
}

std::array<double, kMaxJoints> JointsAt(const TableContent& content, const std::vector<double>& u) {
  const int n = content.header.joints;
  Eigen::MatrixXd weight(n, n);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) weight(i, j) = content.axis[i].weight[j];
  }
  const Eigen::VectorXd q = weight.lu().solve(Eigen::Map<const Eigen::VectorXd>(u.data(), n));
  std::array<double, kMaxJoints> joints{};
  std::copy(q.begin(), q.end(), joints.begin());
  return joints;
}

void FillNodes(TableContent* content) {
  const int n = content->header.joints;
  std::vector<int> index(n, 0);
  content->nodes.clear();
  for (int moved = n; moved != 0;) {
    std::vector<double> u(n);
    for (int i = 0; i < n; ++i) u[i] = NodeAt(content->axis[i], index[i]);
    const auto delta = DeltaByDefinition(content->arm, JointsAt(*content, u).data());
    for (double value : delta) content->nodes.push_back(static_cast<float>(value));
    // The last axis fastest: count up from behind, carry to the front.
    for (moved = n; moved > 0 && ++index[moved - 1] == content->axis[moved - 1].nodes; --moved)
      index[moved - 1] = 0;
  }
}

TableContent SmallTable() {
  TableContent content = Ur10Content(Ur10Arm(1e-3), {2, 3, 2, 3});
  content.header.verification_points = 10000;
  content.header.worst = {1.5e-5, 7e-5};
  content.header.percentile_95 = {1e-5, 5e-5};
  content.header.estimated_worst = {1.6e-5, 7.5e-5};
  content.header.predicted_accuracy_95_m = 3e-4;
  content.header.near_singular_share = 0.125;
  content.arm.effects[2] = {1e-4, {2e-4, 3e-4}, {4e-4, 5e-4}, 6e-6};
  content.arm.masses = 2;
  content.arm.mass[0] = {1, 12.9, {-0.3, 0.05, 0.13}};
  content.arm.mass[1] = {2, 4.3, {-0.9, 0.1, 0.2}};
  FillNodes(&content);
  return content;
}

}  // namespace truepose::compensation::testing
