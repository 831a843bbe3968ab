#include "programs/correct.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/str_format.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "formats/strings.h"
#include "programs/lines.h"
#include "programs/mark.h"
#include "programs/proof.h"
#include "programs/written_number.h"

namespace truepose::programs {
namespace {

// As many as a FaultList shows.
constexpr size_t kMostFaults = 200;

constexpr double kDegPerRad = 180.0 / std::numbers::pi;

absl::Status CheckText(std::string_view text, std::string_view file_name) {
  if (text.find('\0') == std::string_view::npos) return absl::OkStatus();
  return FaultStatus(std::string(file_name), "a NUL byte, as in UTF-16 and in binary files",
                     "program text in ASCII, UTF-8 or a one-byte code page");
}

class Corrector {
 public:
  Corrector(std::string_view text, Dialect dialect, const std::vector<bool>& prismatic,
            const CorrectOptions& options)
      : text_(text),
        dialect_(dialect),
        prismatic_(prismatic),
        options_(options),
        program_(ReadProgram(text, dialect, Joints())) {}

  // Fills changes and uncorrected.
  absl::Status Ask(const Correction& correction) {
    std::vector<std::vector<double>> questions;
    for (size_t i = 0; i < program_.targets.size(); ++i) {
      if (CanAsk(program_.targets[i])) {
        asked_.push_back(i);
        questions.push_back(SiOf(program_.targets[i]));
      }
    }
    if (questions.empty()) return absl::OkStatus();
    TRUEPOSE_ASSIGN_OR_RETURN(const std::vector<CorrectedJoints> answers, correction(questions));
    if (answers.size() != questions.size())
      return absl::InternalError("the correction answered another number of targets");
    for (size_t i = 0; i < answers.size(); ++i) Take(asked_[i], answers[i]);
    return absl::OkStatus();
  }

  absl::Status FaultsOfUncorrected(std::string_view file_name) const {
    FaultList faults;
    std::vector<int> hidden;
    for (const Remark& remark : uncorrected_) {
      if (faults.faults().size() + 1 < kMostFaults || uncorrected_.size() == kMostFaults) {
        faults.Add(formats::StrCat(file_name, ":", remark.line), remark.reason, "");
      } else {
        hidden.push_back(remark.line);
      }
    }
    if (!hidden.empty()) {
      faults.Add(formats::StrCat(file_name, ": lines ", LineNumbers(hidden)),
                 "not corrected either", "");
    }
    return faults.ToStatus();
  }

  absl::StatusOr<CorrectedProgram> Finish() && {
    std::string after = Write();
    TRUEPOSE_RETURN_IF_ERROR(ProveCorrected(text_, program_, expected_, after, dialect_, Joints()));
    MarkedText marked{std::move(after), 0};
    if (!changes_.empty() && !options_.calibration.empty()) {
      TRUEPOSE_ASSIGN_OR_RETURN(marked,
                                AddMark(marked.text, dialect_, Joints(), options_.calibration));
    }
    return CorrectedProgram{std::move(marked.text), marked.line, std::move(changes_),
                            std::move(uncorrected_), std::move(program_.passed_through)};
  }

 private:
  int Joints() const { return static_cast<int>(prismatic_.size()); }

  void Leave(const JointTarget& target, std::string reason) {
    const Remark remark{target.line, formats::StrCat(target.what, ": ", reason)};
    const auto place =
        std::upper_bound(uncorrected_.begin(), uncorrected_.end(), remark,
                         [](const Remark& a, const Remark& b) { return a.line < b.line; });
    uncorrected_.insert(place, remark);
  }

  bool CanAsk(const JointTarget& target) {
    if (target.joints.size() != prismatic_.size()) {
      Leave(target, formats::StrCat(target.joints.size(), " joint values, but the robot has ",
                                    prismatic_.size(), " joints"));
      return false;
    }
    for (size_t j = 0; j < prismatic_.size(); ++j) {
      if (SiPerUnit(target.joints[j].unit, prismatic_[j]) != 0.0) continue;
      Leave(target, formats::StrCat("d2r() for joint ", j + 1, ", which slides"));
      return false;
    }
    return true;
  }

  std::vector<double> SiOf(const JointTarget& target) const {
    std::vector<double> joints;
    for (size_t j = 0; j < prismatic_.size(); ++j)
      joints.push_back(target.joints[j].value * SiPerUnit(target.joints[j].unit, prismatic_[j]));
    return joints;
  }

  void Take(size_t index, const CorrectedJoints& answer) {
    const JointTarget& target = program_.targets[index];
    if (!answer.fault.empty()) return Leave(target, answer.fault);
    if (!IsValid(answer.joints)) return Leave(target, "the correction gave no valid joints");
    if (std::string fault = TooLarge(target, answer.joints); !fault.empty())
      return Leave(target, fault);
    Change change{target.line, target.what, {}, {}};
    for (size_t j = 0; j < prismatic_.size(); ++j) {
      change.before.push_back(target.joints[j].value);
      change.after.push_back(answer.joints[j] / SiPerUnit(target.joints[j].unit, prismatic_[j]));
    }
    expected_.push_back({index, change.after});
    changes_.push_back(std::move(change));
  }

  bool IsValid(const std::vector<double>& joints) const {
    return joints.size() == prismatic_.size() &&
           std::all_of(joints.begin(), joints.end(), [](double q) { return std::isfinite(q); });
  }

  // "" or which joint changes too much.
  std::string TooLarge(const JointTarget& target, const std::vector<double>& corrected) const {
    const std::vector<double> before = SiOf(target);
    for (size_t j = 0; j < prismatic_.size(); ++j) {
      const double change = std::abs(corrected[j] - before[j]);
      if (change <= (prismatic_[j] ? options_.largest_change_m : options_.largest_change_rad))
        continue;
      return formats::StrCat("joint ", j + 1, " would change by ",
                             absl::StrFormat("%.4g", change * (prismatic_[j] ? 1e3 : kDegPerRad)),
                             prismatic_[j] ? " mm" : " deg",
                             ": the target is near a singularity, or of another robot");
    }
    return "";
  }

  // The numbers of all corrected targets in the order of the text, each with its new value.
  std::vector<std::pair<JointNumber, double>> Replacements() const {
    std::vector<std::pair<JointNumber, double>> all;
    for (const Expected& one : expected_) {
      const std::vector<JointNumber>& numbers = program_.targets[one.target].joints;
      for (size_t j = 0; j < numbers.size(); ++j) all.push_back({numbers[j], one.joints[j]});
    }
    std::sort(all.begin(), all.end(),
              [](const auto& a, const auto& b) { return a.first.begin < b.first.begin; });
    return all;
  }

  bool FollowsName(size_t begin) const {
    return begin > 0 && (absl::ascii_isalnum(static_cast<unsigned char>(text_[begin - 1])) ||
                         text_[begin - 1] == '_' || text_[begin - 1] == '$');
  }

  std::string Write() const {
    std::string after;
    size_t at = 0;
    for (const auto& [number, value] : Replacements()) {
      const std::string_view written = text_.substr(number.begin, number.end - number.begin);
      formats::StrAppend(&after, text_.substr(at, number.begin - at),
                         WriteNumber(value, number.unit, written, FollowsName(number.begin)));
      at = number.end;
    }
    formats::StrAppend(&after, text_.substr(at));
    return after;
  }

  const std::string_view text_;
  const Dialect dialect_;
  const std::vector<bool>& prismatic_;
  const CorrectOptions& options_;
  Program program_;
  std::vector<size_t> asked_;
  std::vector<Expected> expected_;
  std::vector<Change> changes_;
  std::vector<Remark> uncorrected_;
};

}  // namespace

absl::StatusOr<CorrectedProgram> CorrectProgram(std::string_view text, std::string_view file_name,
                                                Dialect dialect, const std::vector<bool>& prismatic,
                                                const Correction& correction,
                                                const CorrectOptions& options) {
  TRUEPOSE_RETURN_IF_ERROR(CheckText(text, file_name));
  Corrector corrector(text, dialect, prismatic, options);
  TRUEPOSE_RETURN_IF_ERROR(corrector.Ask(correction));
  if (!options.keep_uncorrected) TRUEPOSE_RETURN_IF_ERROR(corrector.FaultsOfUncorrected(file_name));
  return std::move(corrector).Finish();
}

}  // namespace truepose::programs
