#include "core/compensation/verify_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"
#include "core/compensation/table_error.h"
#include "core/compensation/table_nodes.h"
#include "core/compensation/worst_nodes.h"

namespace truepose {
namespace {

using compensation::Arm;
using compensation::Outcome;
using compensation::PoseError;
using compensation::Table;

constexpr size_t kWorstNodes = 500;
constexpr int kBeside = 8;         // points drawn beside each of them
constexpr int kMostCorners = 64;   // of the cells around a node, of six coordinates all
constexpr int kMostCells = 20000;  // whose middles are looked at; of more, drawn ones
constexpr int kDrawnAtMost = 20;   // for a point asked for
constexpr int kBetweenReports = 1000;

double Percentile95(std::vector<double> values) {
  if (values.empty()) return 0;
  const size_t rank = std::min(values.size() - 1, values.size() * 95 / 100);
  std::nth_element(values.begin(), values.begin() + static_cast<ptrdiff_t>(rank), values.end());
  return values[rank];
}

class Verifier {
 public:
  Verifier(const Table& table, const Arm& arm, const VerifyOptions& options, const Hooks& hooks)
      : table_(table),
        arm_(arm),
        options_(options),
        hooks_(hooks),
        domain_(DomainOfTable(table)),
        grid_(table_.axis, table.header.joints),
        random_(options.seed),
        nodes_(WorstNodes(table, kWorstNodes)),
        cells_(Cells()) {}

  absl::StatusOr<Verification> Verify() {
    TRUEPOSE_RETURN_IF_ERROR(LookAtDrawn());
    TRUEPOSE_RETURN_IF_ERROR(LookAtCells());
    TRUEPOSE_RETURN_IF_ERROR(LookAtWorst());
    result_.percentile_95 = {Percentile95(drawn_m_), Percentile95(drawn_rad_)};
    return result_;
  }

 private:
  int64_t Cells() const {
    int64_t cells = 1;
    for (int k = 0; k < grid_.joints(); ++k) cells *= std::max(1, grid_.nodes(k) - 1);
    return cells;
  }

  absl::Status LookAtDrawn() {
    const auto wanted = static_cast<size_t>(options_.points);
    for (; drawn_m_.size() < wanted && result_.drawn < kDrawnAtMost * options_.points;
         ++result_.drawn) {
      TRUEPOSE_ASSIGN_OR_RETURN(const TablePoint point, LookAt(DrawIn(domain_, &random_)));
      result_.near_singular += point.outcome == Outcome::kNearSingular;
      result_.beyond_limit += point.outcome == Outcome::kBeyondLimit;
      result_.outside_domain += point.outcome == Outcome::kOutsideDomain;
      if (point.outcome != Outcome::kOk) continue;
      ++result_.corrected;
      drawn_m_.push_back(point.error.position_m);
      drawn_rad_.push_back(point.error.rotation_rad);
    }
    return absl::OkStatus();
  }

  absl::Status LookAtCells() {
    const int count = static_cast<int>(std::min<int64_t>(cells_, kMostCells));
    for (int i = 0; i < count; ++i) {
      const int64_t cell = cells_ <= kMostCells
                               ? i
                               : static_cast<int64_t>(random_.Below(static_cast<uint64_t>(cells_)));
      TRUEPOSE_RETURN_IF_ERROR(LookAt(MiddleOf(cell)).status());
    }
    return absl::OkStatus();
  }

  absl::Status LookAtWorst() {
    for (int64_t node : nodes_) {
      for (int corner = 0; corner < std::min(kMostCorners, 1 << Unfolded()); ++corner)
        TRUEPOSE_RETURN_IF_ERROR(LookAt(MiddleBeside(node, corner)).status());
      for (int i = 0; i < kBeside; ++i) TRUEPOSE_RETURN_IF_ERROR(LookAt(DrawBeside(node)).status());
    }
    return absl::OkStatus();
  }

  int Unfolded() const {
    int unfolded = 0;
    for (int k = 0; k < grid_.joints(); ++k) unfolded += grid_.nodes(k) > 1;
    return unfolded;
  }

  // Into the domain: cells reach into the margin.
  JointVector Within(JointVector u) const {
    for (int k = 0; k < u.size(); ++k)
      u(k) = std::clamp(u(k), domain_.range[static_cast<size_t>(k)].lower,
                        domain_.range[static_cast<size_t>(k)].upper);
    return u;
  }

  // The folded coordinates are drawn.
  JointVector MiddleOf(int64_t cell) {
    JointVector u = DrawIn(domain_, &random_);
    for (int k = grid_.joints() - 1; k >= 0; --k) {
      if (grid_.nodes(k) == 1) continue;
      u(k) = grid_.ValueAt(k, static_cast<double>(cell % (grid_.nodes(k) - 1)) + 0.5);
      cell /= grid_.nodes(k) - 1;
    }
    return Within(u);
  }

  JointVector MiddleBeside(int64_t node, int corner) {
    const NodeGrid::Place place = grid_.PlaceOf(node);
    JointVector u = DrawIn(domain_, &random_);
    for (int k = 0; k < grid_.joints(); ++k) {
      if (grid_.nodes(k) == 1) continue;
      u(k) = grid_.ValueAt(k, place[static_cast<size_t>(k)] + (corner & 1 ? 0.5 : -0.5));
      corner >>= 1;
    }
    return Within(u);
  }

  JointVector DrawBeside(int64_t node) {
    const NodeGrid::Place place = grid_.PlaceOf(node);
    JointVector u = DrawIn(domain_, &random_);
    for (int k = 0; k < grid_.joints(); ++k)
      if (grid_.nodes(k) > 1)
        u(k) = grid_.ValueAt(k, place[static_cast<size_t>(k)] + random_.Uniform(-1, 1));
    return Within(u);
  }

  absl::StatusOr<TablePoint> LookAt(const JointVector& u) {
    if (looked_at_++ % kBetweenReports == 0) TRUEPOSE_RETURN_IF_ERROR(Report());
    const JointVector q = domain_.axes.ToController(u);
    const TablePoint point = TableErrorAt(table_, arm_, q.data());
    if (point.outcome == Outcome::kUnreachable || point.outcome == Outcome::kInvalidArgument)
      return NotCorrected(q, point.outcome);
    if (point.outcome != Outcome::kOk) return point;
    ++result_.points;
    result_.worst.position_m = std::max(result_.worst.position_m, point.error.position_m);
    result_.worst.rotation_rad = std::max(result_.worst.rotation_rad, point.error.rotation_rad);
    return point;
  }

  absl::Status NotCorrected(const JointVector& q, Outcome outcome) const {
    std::string joints;
    for (int i = 0; i < q.size(); ++i) {
      const bool slides = arm_.nominal.prismatic[static_cast<size_t>(i)];
      absl::StrAppendFormat(&joints, "%s%.1f %s", i > 0 ? ", " : "",
                            q(i) * (slides ? 1e3 : 180 / std::numbers::pi), slides ? "mm" : "deg");
    }
    FaultList faults;
    faults.Add("domain",
               absl::StrCat("a target that can't be corrected (", compensation::Name(outcome),
                            ") at ", joints),
               "a domain in which corrections are small: narrow the box or the joint ranges, raise "
               "smallest_singular_value, or calibrate with poses from there");
    return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
  }

  absl::Status Report() const {
    if (hooks_.Cancelled()) return absl::CancelledError("cancelled while verifying the table");
    const double all =
        options_.points + static_cast<double>(std::min<int64_t>(cells_, kMostCells)) +
        static_cast<double>(nodes_.size()) * (std::min(kMostCorners, 1 << Unfolded()) + kBeside);
    const double share = std::min(1.0, looked_at_ / all);  // more where many are refused
    hooks_.Report({"verification", options_.begin + (options_.end - options_.begin) * share});
    return absl::OkStatus();
  }

  const Table& table_;
  const Arm& arm_;
  const VerifyOptions& options_;
  const Hooks& hooks_;
  const TableDomain domain_;
  const NodeGrid grid_;
  Random random_;
  const std::vector<int64_t> nodes_;
  const int64_t cells_;
  int looked_at_ = 0;
  std::vector<double> drawn_m_, drawn_rad_;
  Verification result_;
};

}  // namespace

absl::StatusOr<Verification> VerifyTable(const Table& table, const Arm& arm,
                                         const VerifyOptions& options, const Hooks& hooks) {
  return Verifier(table, arm, options, hooks).Verify();
}

}  // namespace truepose
