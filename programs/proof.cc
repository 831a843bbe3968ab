#include "programs/proof.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "formats/strings.h"
#include "programs/written_number.h"

namespace truepose::programs {
namespace {

absl::Status Disproved(int line, std::string_view what) {
  return absl::InternalError(
      formats::StrCat("the corrected text, read again, has ", what, " in line ", line));
}

absl::Status CheckShape(const Program& before, const Program& after) {
  if (before.passed_through != after.passed_through)
    return absl::InternalError("the corrected text, read again, is understood in another way");
  if (before.targets.size() != after.targets.size())
    return absl::InternalError("the corrected text, read again, has another number of targets");
  for (size_t i = 0; i < before.targets.size(); ++i) {
    const JointTarget &a = before.targets[i], &b = after.targets[i];
    if (a.line != b.line || a.what != b.what || a.joints.size() != b.joints.size())
      return Disproved(b.line, "another target");
  }
  return absl::OkStatus();
}

// The last bits are those of the decimal number itself.
double Tolerance(const JointNumber& number, std::string_view written) {
  return PrintedPrecision(number.unit, written) * (1.0 + 1e-6) +
         4 * std::numeric_limits<double>::epsilon() * std::abs(number.value);
}

absl::Status CheckNumbers(std::string_view before, const JointTarget& target,
                          const JointTarget& read, const std::vector<double>& joints) {
  for (size_t j = 0; j < joints.size(); ++j) {
    const JointNumber &old = target.joints[j], &now = read.joints[j];
    const double tolerance = Tolerance(now, before.substr(old.begin, old.end - old.begin));
    if (!(std::abs(now.value - joints[j]) <= tolerance) || now.unit != old.unit)
      return Disproved(read.line, formats::StrCat("another value of joint ", j + 1));
  }
  return absl::OkStatus();
}

std::vector<JointNumber> Replaced(const Program& program, const std::vector<Expected>& expected) {
  std::vector<JointNumber> numbers;
  for (const Expected& one : expected) {
    const std::vector<JointNumber>& joints = program.targets[one.target].joints;
    numbers.insert(numbers.end(), joints.begin(), joints.end());
  }
  std::sort(numbers.begin(), numbers.end(),
            [](const JointNumber& a, const JointNumber& b) { return a.begin < b.begin; });
  return numbers;
}

// The text without those numbers.
std::string Rest(std::string_view text, const std::vector<JointNumber>& numbers) {
  std::string rest;
  size_t at = 0;
  for (const JointNumber& number : numbers) {
    formats::StrAppend(&rest, text.substr(at, number.begin - at), std::string(1, '\0'));
    at = number.end;
  }
  formats::StrAppend(&rest, text.substr(at));
  return rest;
}

}  // namespace

absl::Status ProveCorrected(std::string_view before, const Program& program,
                            const std::vector<Expected>& expected, std::string_view after,
                            Dialect dialect, int joints) {
  const Program again = ReadProgram(after, dialect, joints);
  if (absl::Status status = CheckShape(program, again); !status.ok()) return status;
  for (const Expected& one : expected) {
    const absl::Status status =
        CheckNumbers(before, program.targets[one.target], again.targets[one.target], one.joints);
    if (!status.ok()) return status;
  }
  if (Rest(before, Replaced(program, expected)) != Rest(after, Replaced(again, expected)))
    return absl::InternalError("the corrected text differs beside its joint numbers");
  return absl::OkStatus();
}

}  // namespace truepose::programs
