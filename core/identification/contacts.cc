#include "core/identification/contacts.h"

#include <Eigen/Dense>
#include <utility>

#include "core/identification/prediction.h"

namespace truepose {
namespace {

constexpr int kMostSteps = 20;
// 1 pm: relations then hold to 1e-11 of columns of some 0.1 m/rad, far below the threshold of 1e-7.
constexpr double kMeets = 1e-12;
constexpr double kMostMove = 0.5;
// Directions weaker than this share of the strongest are an arm at a singular pose; a step along
// them would be radians.
constexpr double kSingular = 1e-3;

bool MovesToContact(const Reading& reading) {
  return reading.contact &&
         (reading.kind == ObservationKind::kPoint || reading.kind == ObservationKind::kPointAxis);
}

Eigen::VectorXd LeastStep(const RowJacobian& J, const Residual& r) {
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(J, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(kSingular);
  return svd.solve(Eigen::VectorXd(r));
}

void MoveToContact(const Problem& problem, const Estimate& estimate, Workspace* workspace,
                   Reading* reading) {
  Reading moved = *reading;
  for (int step = 0; step < kMostSteps; ++step) {
    const Residual r = ResidualAt(problem, moved, estimate);
    if (r.lpNorm<Eigen::Infinity>() < kMeets) {
      reading->q = std::move(moved.q);
      return;
    }
    moved.q -= LeastStep(JointJacobian(problem, moved, estimate, workspace), r);
    if ((moved.q - reading->q).lpNorm<Eigen::Infinity>() > kMostMove) return;
  }
}

}  // namespace

Problem AtContacts(Problem problem, const Estimate& estimate) {
  Workspace workspace;
  for (size_t i = 0; i < problem.readings.size(); ++i) {
    Reading reading = problem.readings[i];
    if (!MovesToContact(reading)) continue;
    MoveToContact(problem, estimate, &workspace, &reading);
    problem.readings[i].q = std::move(reading.q);
  }
  return problem;
}

}  // namespace truepose
