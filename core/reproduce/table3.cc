#include "core/reproduce/table3.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numbers>

#include "core/base/random.h"
#include "core/base/status_macros.h"
#include "core/identification/identifiability.h"
#include "core/models/build_model.h"
#include "core/reproduce/printed_table3.h"
#include "core/robot/dh.h"

namespace truepose {
namespace {

constexpr int kPoses = 60;
constexpr double kQuarterTurn = std::numbers::pi / 2;
constexpr double kInSpan = 1e-9;  // of a column's norm; exact relations leave 1e-14

absl::StatusOr<Robot> StanfordArm() {
  const std::vector<DhRow> rows = {
      {0, .412, 0, kQuarterTurn}, {0, .154, 0, kQuarterTurn}, {0, .4, 0, 0},
      {0, 0, 0, -kQuarterTurn},   {0, 0, 0, kQuarterTurn},    {0, .263, 0, 0}};
  std::vector<JointType> types(6, JointType::kRevolute);
  types[2] = JointType::kPrismatic;
  Chain chain = ChainFromStandardDh(rows, types);
  chain.insert(chain.begin(), Translation(Axis::kX, .2));  // d0
  std::vector<Joint> joints;
  for (JointType type : types) joints.push_back({"j" + std::to_string(joints.size() + 1), type});
  return Robot::Create(joints, chain, JointMap::Identity(6));
}

// Columns of motions of the flange point, stacked over the poses.
struct Stack {
  Eigen::MatrixXd parameters, base, tool;
};

Stack StackOf(const Model& model) {
  const int n = model.parameters.size();
  Stack stack = {Eigen::MatrixXd(6 * kPoses, n), Eigen::MatrixXd(6 * kPoses, 6),
                 Eigen::MatrixXd::Zero(6 * kPoses, 6)};
  const Eigen::VectorXd lambda = Eigen::VectorXd::Zero(n);
  Random random(3);
  ModelSweep sweep;
  for (int pose = 0; pose < kPoses; ++pose) {
    Eigen::VectorXd q(6);
    for (int i = 0; i < 6; ++i) q(i) = i == 2 ? random.Uniform(-.3, .3) : random.Uniform(-1.5, 1.5);
    RunSweep(model, q.data(), lambda.data(), {}, &sweep);
    const Pose& X = sweep.X_BF;
    for (int i = 0; i < n; ++i)
      stack.parameters.block<6, 1>(6 * pose, i) = TwistAt(X.p, sweep.J_parameters.col(i));
    for (int i = 0; i < 6; ++i)
      stack.base.block<6, 1>(6 * pose, i) = TwistAt(X.p, Eigen::Matrix<double, 6, 1>::Unit(i));
    stack.tool.block<3, 3>(6 * pose, 0) = stack.tool.block<3, 3>(6 * pose + 3, 3) = X.R;
  }
  return stack;
}

// Names of the kept parameters whose columns lie in the span.
std::vector<std::string> NamesInSpan(const Stack& stack, const Eigen::MatrixXd& span,
                                     const ParameterSet& parameters, const std::vector<int>& kept) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(span);
  std::vector<std::string> names;
  for (int i : kept) {
    const Eigen::VectorXd column = stack.parameters.col(i);
    if ((span * qr.solve(column) - column).norm() < kInSpan * column.norm())
      names.push_back(parameters[i].name);
  }
  return names;
}

Eigen::Index RankOf(const Eigen::MatrixXd& columns) {
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
  qr.setThreshold(kInSpan);
  return qr.compute(columns).rank();
}

Table3Column ColumnOf(const Model& model) {
  const Stack stack = StackOf(model);
  IdentifiabilityOptions options;
  options.use_sd_bounds = false;
  const IdentifiableSet set = Identifiable(stack.parameters, model.parameters, options);
  Table3Column column;
  column.model = model.kind;
  for (int i : set.active) column.names.push_back(model.parameters[i].name);
  column.base = NamesInSpan(stack, stack.base, model.parameters, set.active);
  column.gripper = NamesInSpan(stack, stack.tool, model.parameters, set.active);
  for (const NullRelation& relation : set.redundancies)
    column.redundant.push_back(RelationText(relation, model.parameters));
  Eigen::MatrixXd external(stack.base.rows(), 12);
  external << stack.base, stack.tool;
  column.internal = static_cast<int>(column.names.size()) - static_cast<int>(RankOf(external));
  FillPrinted(&column);
  return column;
}

}  // namespace

absl::StatusOr<std::vector<Table3Column>> Table3() {
  TRUEPOSE_ASSIGN_OR_RETURN(const Robot robot, StanfordArm());
  std::vector<Table3Column> columns;
  for (const char* kind : {"extended_dh", "incremental", "modified_incremental", "zhuang_roth"}) {
    TRUEPOSE_ASSIGN_OR_RETURN(const Model model, BuildModel(kind, robot, ModelExtent::kComplete));
    columns.push_back(ColumnOf(model));
  }
  return columns;
}

}  // namespace truepose
