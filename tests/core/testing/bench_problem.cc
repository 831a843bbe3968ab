#include "tests/core/testing/bench_problem.h"

#include "tests/core/testing/robots.h"
#include "tests/core/testing/table.h"

namespace truepose::testing {
namespace {

// Values of one column of *_params.csv: base 4, then theta d a alpha beta a joint, then tool 6.
struct Parameters {
  std::vector<double> v;
  const double* Link(int i) const { return &v[4 + 5 * i]; }
  const double* Tool() const { return &v[v.size() - 6]; }
};

Parameters ReadParameters(const std::string& path, int column) {
  Parameters parameters;
  for (const auto& row : ReadTable(path)) parameters.v.push_back(row[column]);
  return parameters;
}

Chain TrueChain(const Parameters& p, int joints) {
  Chain chain = {Translation(Axis::kX, p.v[0]), Translation(Axis::kY, p.v[1]),
                 Rotation(Axis::kX, p.v[2]), Rotation(Axis::kY, p.v[3])};
  for (int i = 0; i < joints; ++i) {
    const double* link = p.Link(i);
    chain.push_back({Motion::kRotation, Axis::kZ, link[0], i, -1});
    chain.push_back(Translation(Axis::kZ, link[1]));
    chain.push_back(Translation(Axis::kX, link[2]));
    chain.push_back(Rotation(Axis::kX, link[3]));
    chain.push_back(Rotation(Axis::kY, link[4]));
  }
  const Axis axes[] = {Axis::kX, Axis::kY, Axis::kZ};
  for (int k = 0; k < 3; ++k) chain.push_back(Translation(axes[k], p.Tool()[k]));
  for (int k = 0; k < 3; ++k) chain.push_back(Rotation(axes[k], p.Tool()[3 + k]));
  return chain;
}

Robot NominalRobot(const Parameters& p, int joints) {
  std::vector<DhRow> rows;
  for (int i = 0; i < joints; ++i)
    rows.push_back({p.Link(i)[0], p.Link(i)[1], p.Link(i)[2], p.Link(i)[3]});
  return DhRobot(rows, std::string(joints, 'R'));
}

Reading ReadingOf(const std::vector<double>& row, int joints, ObservationKind kind) {
  Reading reading;
  reading.q = Eigen::Map<const Eigen::VectorXd>(row.data(), joints);
  reading.kind = kind;
  const double* x = row.data() + joints;
  reading.X_MT.p = {x[0], x[1], x[2]};
  reading.X_MT.R = RotationOf<double>(Eigen::Vector4d(x[4], x[5], x[6], x[3]).normalized());
  reading.axis_M = reading.X_MT.R.col(2);
  return reading;
}

}  // namespace

BenchProblem LoadBench(const std::string& name, int poses, ObservationKind kind) {
  const int joints = name == "arm5" ? 5 : 6;
  const std::string folder = SharedFolder() + "/bench/";
  BenchProblem problem{NominalRobot(ReadParameters(folder + name + "_params.csv", 1), joints),
                       {},
                       TrueChain(ReadParameters(folder + name + "_params.csv", 2), joints),
                       joints};
  for (const auto& row : ReadTable(folder + name + "_" + std::to_string(poses) + ".csv")) {
    problem.readings.push_back(ReadingOf(row, joints, kind));
    problem.readings.back().id = static_cast<int>(problem.readings.size()) - 1;
  }
  return problem;
}

}  // namespace truepose::testing
