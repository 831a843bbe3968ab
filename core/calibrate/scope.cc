#include "core/calibrate/scope.h"

#include <set>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "core/base/fault.h"

namespace truepose {
namespace {

std::vector<std::string> WordsOf(const std::string& text) {
  std::vector<std::string> words;
  for (absl::string_view word : absl::StrSplit(text, ',', absl::SkipWhitespace()))
    words.emplace_back(absl::StripAsciiWhitespace(word));
  return words;
}

// Words that free no internal parameter by themselves.
bool IsWord(const std::string& word) {
  return word == "all" || word == "internal" || word == "external" || word == "base" ||
         word == "tool";
}

std::string InternalNames(const Problem& problem) {
  std::vector<std::string> names;
  for (const Parameter& parameter : problem.model->parameters) names.push_back(parameter.name);
  return absl::StrJoin(names, ", ");
}

// Adds the internal candidates that a word names. @returns whether it names any.
bool AddInternal(const std::string& word, const Problem& problem, std::set<int>* free) {
  const ParameterSet& parameters = problem.model->parameters;
  const size_t before = free->size();
  for (int i = 0; i < parameters.size(); ++i) {
    const bool offset =
        word == "joint_offsets" && parameters[i].role == ParameterRole::kJointOffset;
    if (offset || parameters[i].name == word) free->insert(problem.FirstInternal() + i);
  }
  return free->size() > before || parameters.Find(word).has_value();
}

void AddFrames(const Problem& problem, const Scope& scope, std::set<int>* free) {
  for (int i = 0; i < problem.FirstInternal(); ++i) {
    const bool of_base = i < problem.FirstOfTool(0);
    const bool of_tool = !of_base && i < problem.FirstOfOffsets();
    if ((of_base && !scope.base) || (of_tool && !scope.tool)) continue;
    free->insert(i);
  }
}

}  // namespace

bool IsPartial(const std::string& text) {
  for (const std::string& word : WordsOf(text))
    if (word == "all" || word == "internal") return false;
  return !WordsOf(text).empty();
}

absl::StatusOr<Scope> ScopeOf(const std::string& text, const Problem& problem) {
  Scope scope;
  const std::vector<std::string> words = WordsOf(text);
  if (words.empty() && !text.empty())
    return FaultStatus("options.calibrate", absl::StrCat("'", text, "', an empty list"),
                       "a word or the name of a parameter");
  scope.tool = words != std::vector<std::string>{"base"};
  scope.base = words != std::vector<std::string>{"tool"};
  std::set<int> free;
  FaultList faults;
  for (const std::string& word : words) {
    if (IsWord(word)) continue;
    if (const auto index = problem.model->parameters.Find(word))
      scope.named.push_back(problem.FirstInternal() + *index);
    if (AddInternal(word, problem, &free)) continue;
    faults.Add("options.calibrate", absl::StrCat("'", word, "'"),
               absl::StrCat("all, internal, external, base, tool, joint_offsets, or parameters of ",
                            "the model: ", InternalNames(problem)));
  }
  if (!faults.empty()) return faults.ToStatus();
  if (!IsPartial(text)) return Scope{};
  AddFrames(problem, scope, &free);
  scope.free.assign(free.begin(), free.end());
  return scope;
}

}  // namespace truepose
