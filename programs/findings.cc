#include "programs/findings.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::programs {

void Findings::AddValue(const std::string& name, JointTarget target, bool typed) {
  valued_.insert(name);
  values_.push_back({name, std::move(target), typed});
}

void Findings::JudgeValues() {
  for (const Place& motion : motions_) moved_to_.insert(motion.name);
  for (Value& value : values_) {
    const auto other_use = other_uses_.find(value.name);
    if (!value.typed && !moved_to_.contains(value.name)) continue;  // any list of numbers
    if (other_use == other_uses_.end()) {
      corrected_.insert(value.name);
      targets_.push_back(std::move(value.target));
      continue;
    }
    PassThrough(value.target.line,
                formats::StrCat(formats::Quoted(value.name), " is used in line ", other_use->second,
                                " other than as the target of a motion"));
  }
}

void Findings::JudgeMotions() {
  for (const Place& motion : motions_) {
    if (corrected_.contains(motion.name)) continue;
    PassThrough(motion.line,
                formats::StrCat("moves to ", formats::Quoted(motion.name),
                                valued_.contains(motion.name)
                                    ? ", whose joint values are left as they are"
                                    : ", which has no plain joint values in this file"));
  }
}

// A variable may have joint values here and the result of a calculation there.
void Findings::JudgeOtherValues() {
  for (const Place& value : other_values_) {
    if (!corrected_.contains(value.name)) continue;
    PassThrough(value.line, formats::StrCat(formats::Quoted(value.name),
                                            " gets a value that is no plain list of numbers"));
  }
}

Program Findings::Finish() && {
  JudgeValues();
  JudgeMotions();
  JudgeOtherValues();
  std::sort(targets_.begin(), targets_.end(),
            [](const JointTarget& a, const JointTarget& b) { return a.begin() < b.begin(); });
  std::stable_sort(remarks_.begin(), remarks_.end(), [](const Remark& a, const Remark& b) {
    return std::tie(a.line, a.reason) < std::tie(b.line, b.reason);
  });
  remarks_.erase(std::unique(remarks_.begin(), remarks_.end()), remarks_.end());
  return {std::move(targets_), std::move(remarks_)};
}

}  // namespace truepose::programs
