#include "core/reproduce/table2.h"

#include <numbers>

#include "core/chain/chain.h"

namespace truepose {
namespace {

constexpr double kQuarterTurn = std::numbers::pi / 2;

// The chain of Eq. 32 with its parameters numbered as the table's columns.
class Links {
 public:
  // B of the link: T(x, da) T(y, db) R(x, dalpha) R(y, dbeta), then R(z, dq) of the next joint.
  void AppendErrors(const std::string& link, const std::string& joint) {
    Append("da_" + link, Motion::kTranslation, Axis::kX);
    Append("db_" + link, Motion::kTranslation, Axis::kY);
    Append("dalpha_" + link, Motion::kRotation, Axis::kX);
    Append("dbeta_" + link, Motion::kRotation, Axis::kY);
    Append("dq_" + joint, Motion::kRotation, Axis::kZ);
  }

  void AppendLink(double q, double l, double twist) {
    chain_.back().constant = q;
    chain_.push_back(Translation(Axis::kX, l));
    chain_.push_back(Rotation(Axis::kX, twist));
  }

  const Chain& chain() const { return chain_; }
  const std::vector<std::string>& names() const { return names_; }

 private:
  void Append(const std::string& name, Motion motion, Axis axis) {
    chain_.push_back({motion, axis, 0.0, -1, static_cast<int>(names_.size())});
    names_.push_back(name);
  }

  Chain chain_;
  std::vector<std::string> names_;
};

std::vector<std::string> Printed() {
  return {"1 0 0 0 0 0",
          "0 1 0 0 0 0",
          "0 0 0 1 0 0",
          "0 0 0 0 1 0",
          "0 0 0 0 0 1",
          "C S 0 0 0 0",
          "0 0 1 0 0 0",
          "0 0 0 C S 0",
          "lS -lC 0 0 0 1",
          "0 0 -l S -C 0",
          "CC' SC' S' 0 0 0",
          "-S C 0 0 0 0",
          "...",
          "...",
          "..."};
}

}  // namespace

Table2Result Table2(const Table2Arguments& arguments) {
  Links links;
  links.AppendErrors("{i-1}", "i");
  links.AppendLink(arguments.q, arguments.l, kQuarterTurn);
  links.AppendErrors("i", "{i+1}");
  links.AppendLink(arguments.q_next, arguments.l_next, -kQuarterTurn);
  links.AppendErrors("{i+1}", "{i+2}");
  const Eigen::VectorXd lambda = Eigen::VectorXd::Zero(ParameterCount(links.chain()));
  Sweep sweep;
  RunSweep(links.chain(), nullptr, lambda.data(), &sweep);
  const auto j = [&](int column) { return sweep.J_parameters.col(column - 1); };
  return {links.names(), sweep.J_parameters, Printed(), j(5) - j(9) - arguments.l * j(12)};
}

}  // namespace truepose
