#include "core/calibrate/scope.h"

#include <set>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

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

std::string InternalNames(const Model& model) {
  std::vector<std::string> names;
  for (const Parameter& parameter : model.parameters) names.push_back(parameter.name);
  return absl::StrJoin(names, ", ");
}

// Whether a word names that internal candidate.
bool Names(const std::string& word, const Parameter& parameter) {
  return parameter.name == word ||
         (word == "joint_offsets" && parameter.role == ParameterRole::kJointOffset);
}

bool NamesAny(const std::string& word, const ParameterSet& parameters) {
  for (const Parameter& parameter : parameters)
    if (Names(word, parameter)) return true;
  return false;
}

// Adds the internal candidates that a word names.
void AddInternal(const std::string& word, const Problem& problem, std::set<int>* free) {
  const ParameterSet& parameters = problem.model->parameters;
  for (int i = 0; i < parameters.size(); ++i)
    if (Names(word, parameters[i])) free->insert(problem.FirstInternal() + i);
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

absl::Status CheckScope(const std::string& text, const Model& model) {
  const std::vector<std::string> words = WordsOf(text);
  if (words.empty() && !text.empty())
    return FaultStatus("options.calibrate", absl::StrCat("'", text, "', an empty list"),
                       "a word or the name of a parameter");
  FaultList faults;
  for (const std::string& word : words) {
    if (IsWord(word) || NamesAny(word, model.parameters)) continue;
    faults.Add("options.calibrate", absl::StrCat("'", word, "'"),
               absl::StrCat("all, internal, external, base, tool, joint_offsets, or parameters of ",
                            "the model: ", InternalNames(model)));
  }
  return faults.ToStatus();
}

absl::StatusOr<Scope> ScopeOf(const std::string& text, const Problem& problem) {
  TRUEPOSE_RETURN_IF_ERROR(CheckScope(text, *problem.model));
  Scope scope;
  const std::vector<std::string> words = WordsOf(text);
  scope.tool = words != std::vector<std::string>{"base"};
  scope.base = words != std::vector<std::string>{"tool"};
  std::set<int> free;
  for (const std::string& word : words) {
    if (IsWord(word)) continue;
    if (const auto index = problem.model->parameters.Find(word))
      scope.named.push_back(problem.FirstInternal() + *index);
    AddInternal(word, problem, &free);
  }
  if (!IsPartial(text)) return Scope{};
  AddFrames(problem, scope, &free);
  scope.free.assign(free.begin(), free.end());
  return scope;
}

}  // namespace truepose
