#include "core/planning/d_optimal.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

namespace truepose {
namespace {

using Blocks = std::vector<Eigen::MatrixXd>;

// Of the information of all blocks: what the first few blocks do not tell yet is this weakly known,
// so that their gains can be compared. Small enough that it decides nothing once M has full rank.
constexpr double kFloor = 1e-6;
// An exchange must gain more than rounding does, or the search might never end.
constexpr double kLeastGain = 1e-9;
constexpr int kMostSweeps = 30;

Eigen::MatrixXd Stacked(const Blocks& blocks) {
  Eigen::Index rows = 0;
  for (const Eigen::MatrixXd& block : blocks) rows += block.rows();
  Eigen::MatrixXd all(rows, blocks.front().cols());
  rows = 0;
  for (const Eigen::MatrixXd& block : blocks) {
    all.middleRows(rows, block.rows()) = block;
    rows += block.rows();
  }
  return all;
}

// The blocks in coordinates in which all of them together have unit information: parameters of any
// unit count alike, and log det moves by a constant only.
Blocks Decorrelated(const Blocks& blocks) {
  const Eigen::VectorXd scale = Stacked(blocks).colwise().norm().cwiseMax(1e-300).cwiseInverse();
  const Eigen::MatrixXd R =
      Eigen::HouseholderQR<Eigen::MatrixXd>(Stacked(blocks) * scale.asDiagonal())
          .matrixQR()
          .topRows(scale.size());
  Blocks result;
  for (const Eigen::MatrixXd& block : blocks)
    result.push_back(
        R.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(block * scale.asDiagonal()));
  return result;
}

// M^-1 of the chosen blocks and J_h M^-1 J_h' of every block, kept up to date.
class Search {
 public:
  explicit Search(const Blocks& blocks) : blocks_(blocks), is_chosen_(blocks.size(), false) {
    Refresh();
  }

  void Add(int h) { Move(h, true); }
  void Remove(int h) { Move(h, false); }

  // The block outside that gains most, and by how much; -1 where there is none.
  int Best(double* gain) const {
    int best = -1;
    for (size_t h = 0; h < blocks_.size(); ++h) {
      if (is_chosen_[h]) continue;
      const double candidate = Gain(static_cast<int>(h));
      if (best >= 0 && candidate <= *gain + kLeastGain) continue;
      best = static_cast<int>(h);
      *gain = candidate;
    }
    return best;
  }

  double Gain(int h) const {
    const Eigen::MatrixXd& V = spread_[static_cast<size_t>(h)];
    const Eigen::MatrixXd sum = Eigen::MatrixXd::Identity(V.rows(), V.cols()) + V;
    return 2 * Eigen::MatrixXd(sum.llt().matrixL()).diagonal().array().log().sum();
  }

  // From the chosen blocks anew: thousands of updates leave rounding behind.
  void Refresh() {
    const Eigen::Index p = blocks_.front().cols();
    Eigen::MatrixXd M = kFloor * Eigen::MatrixXd::Identity(p, p);
    for (int h : Chosen())
      M += blocks_[static_cast<size_t>(h)].transpose() * blocks_[static_cast<size_t>(h)];
    inverse_ = M.llt().solve(Eigen::MatrixXd::Identity(p, p));
    spread_.clear();
    for (const Eigen::MatrixXd& J : blocks_) spread_.push_back(J * inverse_ * J.transpose());
  }

  std::vector<int> Chosen() const {
    std::vector<int> chosen;
    for (size_t h = 0; h < is_chosen_.size(); ++h)
      if (is_chosen_[h]) chosen.push_back(static_cast<int>(h));
    return chosen;
  }

 private:
  // (M +- J'J)^-1 = M^-1 -+ U U' with U = M^-1 J' L^-T, L L' = I +- J M^-1 J'.
  void Move(int h, bool in) {
    is_chosen_[static_cast<size_t>(h)] = in;
    const double sign = in ? 1 : -1;
    const Eigen::MatrixXd& J = blocks_[static_cast<size_t>(h)];
    const Eigen::MatrixXd inner =
        Eigen::MatrixXd::Identity(J.rows(), J.rows()) + sign * spread_[static_cast<size_t>(h)];
    const Eigen::MatrixXd L = inner.llt().matrixL();
    const Eigen::MatrixXd U = L.triangularView<Eigen::Lower>().solve(J * inverse_).transpose();
    inverse_ -= sign * U * U.transpose();
    for (size_t k = 0; k < blocks_.size(); ++k) {
      const Eigen::MatrixXd JU = blocks_[k] * U;
      spread_[k] -= sign * JU * JU.transpose();
    }
  }

  const Blocks& blocks_;
  std::vector<bool> is_chosen_;
  Eigen::MatrixXd inverse_;
  std::vector<Eigen::MatrixXd> spread_;
};

// One exchange of each chosen block, where that gains. @returns whether any did.
bool Sweep(Search* search, const Hooks& hooks) {
  bool gained = false;
  search->Refresh();
  for (int h : search->Chosen()) {
    if (hooks.Cancelled()) return false;
    search->Remove(h);
    const double own = search->Gain(h);
    double gain = own;
    const int best = search->Best(&gain);
    const bool better = best != h && gain > own + kLeastGain;
    search->Add(better ? best : h);
    gained = gained || better;
  }
  return gained;
}

}  // namespace

double LogDetOf(const Blocks& blocks, const std::vector<int>& chosen) {
  Blocks part;
  for (int h : chosen) part.push_back(blocks[static_cast<size_t>(h)]);
  const double none = -std::numeric_limits<double>::infinity();
  if (part.empty()) return none;
  const Eigen::MatrixXd J = Stacked(part);
  if (J.rows() < J.cols()) return none;
  const Eigen::VectorXd norm = J.colwise().norm().cwiseMax(1e-300);
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(J * norm.cwiseInverse().asDiagonal());
  if (qr.rank() < J.cols()) return none;
  const auto R = qr.matrixR().topLeftCorner(J.cols(), J.cols());
  return 2 * (R.diagonal().cwiseAbs().array().log().sum() + norm.array().log().sum());
}

std::vector<int> ChooseDOptimal(const Blocks& blocks, int count, const Hooks& hooks) {
  const Blocks decorrelated = Decorrelated(blocks);
  Search search(decorrelated);
  for (int i = 0; i < count && !hooks.Cancelled(); ++i) {
    double gain = 0;
    search.Add(search.Best(&gain));
  }
  for (int sweep = 0; sweep < kMostSweeps && Sweep(&search, hooks); ++sweep) {
  }
  return search.Chosen();
}

}  // namespace truepose
