// What tests of several models share.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/models/build_model.h"
#include "tests/core/testing/robots.h"

namespace truepose::testing {

// BuildModel that must succeed.
Model ModelOf(const std::string& kind, const Robot& robot, ModelExtent extent);

// Twists of the flange point by the model's parameters at nominal, stacked over random poses:
// 6 poses rows.
Eigen::MatrixXd StackedJacobian(const Robot& robot, const Model& model, int poses, uint64_t seed);

// The same of the six motions of the base frame, at the base's origin, and of the tool frame.
Eigen::MatrixXd StackedBaseMotions(const Robot& robot, int poses, uint64_t seed);
Eigen::MatrixXd StackedToolMotions(const Robot& robot, int poses, uint64_t seed);

// Of columns scaled to norm 1, singular values above 1e-9 of the largest.
int RankOf(const Eigen::MatrixXd& columns);

// The columns of the parameters of these names.
Eigen::MatrixXd Columns(const Eigen::MatrixXd& J, const Model& model,
                        const std::vector<std::string>& names);

Eigen::MatrixXd SideBySide(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

// The Stanford arm with its first axis d0 = 0.2 m beside the base, as in Table 3.
Robot StanfordBesideBase();

struct NamedRobot {
  std::string name;
  Robot robot;
};
// The counted robots, and chains that are awkward for D&H: joints about x and y, axes in opposite
// directions, nearly parallel and skew ones, a flange turned by 90 deg, a prismatic joint beside a
// parallel axis.
std::vector<NamedRobot> AllRobots();

}  // namespace truepose::testing
