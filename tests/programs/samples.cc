#include "tests/programs/samples.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "formats/number.h"

namespace truepose::programs {

std::string Targets(const Program& program) {
  std::string text;
  for (const JointTarget& target : program.targets) {
    text += std::to_string(target.line) + " " + target.what + ":";
    for (const JointNumber& number : target.joints) {
      text += " " + formats::FormatNumber(number.value);
      if (number.unit == Unit::kDegreesFunction) text += "'";
    }
    text += "\n";
  }
  return text;
}

std::string Remarks(const Program& program) {
  std::string text;
  for (const Remark& remark : program.passed_through)
    text += std::to_string(remark.line) + " " + remark.reason + "\n";
  return text;
}

std::vector<CorrectedJoints> Shifted(const std::vector<std::vector<double>>& targets) {
  std::vector<CorrectedJoints> answers = Unchanged(targets);
  for (CorrectedJoints& answer : answers) {
    for (size_t j = 0; j < answer.joints.size(); ++j) answer.joints[j] += 0.001 * (j + 1);
  }
  return answers;
}

std::vector<CorrectedJoints> Unchanged(const std::vector<std::vector<double>>& targets) {
  std::vector<CorrectedJoints> answers;
  for (const std::vector<double>& target : targets) answers.push_back({target, ""});
  return answers;
}

std::string Golden(const std::string& name) {
  std::ifstream file(std::string(TRUEPOSE_SOURCE_DIR) + "/tests/programs/golden/" + name,
                     std::ios::binary);
  EXPECT_TRUE(file.good()) << name;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

}  // namespace truepose::programs
