#include "programs/rapid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_set>
#include <utility>

#include "formats/strings.h"
#include "formats/wording.h"
#include "programs/findings.h"
#include "programs/number_list.h"

namespace truepose::programs {
namespace {

constexpr size_t kAxes = 6;
constexpr size_t kLongestIndex = 100;    // words
constexpr double kAxisNotThere = 8.9e9;  // 9E9 in every spelling

constexpr std::array<std::string_view, 6> kJointMotions = {
    "moveabsj", "moveabsjdo", "moveabsjao", "moveabsjgo", "moveabsjsync", "triggabsj"};
constexpr std::array<std::string_view, 20> kPoseMotions = {
    "movej",     "movel",   "movec",   "movejdo", "moveldo", "movecdo",   "movejao",
    "movelao",   "movecao", "movejgo", "movelgo", "movecgo", "movejsync", "movelsync",
    "movecsync", "triggj",  "triggl",  "triggc",  "searchl", "searchc"};

constexpr char kPoseMotion[] =
    "a motion to a robtarget: the controller finds its joints by its own kinematics, so it is not "
    "corrected";
constexpr char kMayBeJoints[] =
    "joint values that are neither a joint motion's target nor a jointtarget's value";
constexpr char kRobtarget[] = "a robtarget is a pose: not corrected";

template <class List>
bool Has(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

bool IsJointTarget(const NumberNode& node) {
  return node.items.size() == 2 && node.items[0].IsFlat() && node.items[1].IsFlat() &&
         node.items[0].items.size() == kAxes && node.items[1].items.size() == kAxes;
}

// Whether it is, or holds, a jointtarget or six numbers that may be a robjoint. A robtarget's last
// six do not count.
bool MayBeJoints(const NumberNode& node) {
  if (node.IsFlat()) return node.items.size() == kAxes;
  if (IsJointTarget(node)) return true;
  const bool all_flat = std::all_of(node.items.begin(), node.items.end(),
                                    [](const NumberNode& item) { return item.IsFlat(); });
  const bool is_robtarget = node.items.size() == 4 && all_flat && node.items[0].items.size() == 3;
  return !is_robtarget && std::any_of(node.items.begin(), node.items.end(), MayBeJoints);
}

JointTarget TargetOf(const NumberNode& node, std::string_view what) {
  std::vector<JointNumber> joints = node.items[0].Numbers();
  std::erase_if(joints, [](const JointNumber& n) { return std::abs(n.value) > kAxisNotThere; });
  return {node.line, std::string(what), std::move(joints)};
}

// All joint targets of an array. @returns false when anything in it is none.
bool Collect(const NumberNode& node, std::string_view what, std::vector<JointTarget>* targets) {
  if (IsJointTarget(node)) {
    targets->push_back(TargetOf(node, what));
    return true;
  }
  if (node.IsNumber() || node.items.empty()) return false;
  return std::all_of(node.items.begin(), node.items.end(),
                     [&](const NumberNode& item) { return Collect(item, what, targets); });
}

class Reader {
 public:
  explicit Reader(std::string_view text)
      : words_(text, {.comment = '!', .name_marks = "", .doubled_quotes = true}) {}

  Program Read() {
    for (size_t i = 0; !words_.IsEnd(i); ++i) {
      if (words_.Lower(i) == "jointtarget") declared_.insert(words_.Lower(Next(i)));
    }
    for (size_t i = 0; !words_.IsEnd(i);) i = ReadAt(i);
    return std::move(findings_).Finish();
  }

 private:
  // Line ends mean nothing in RAPID.
  size_t Next(size_t i) const { return words_.SkipLineEnds(i + 1); }

  // Each returns the place from which to go on, behind `i`.
  size_t ReadAt(size_t i) {
    if (words_.Is(i, TokenKind::kUnclear) && words_.Text(i).front() == '"')
      findings_.PassThrough(words_.Line(i), "a text without an end: the rest is not read");
    if (words_.IsSign(i, "[")) return ReadList(i);
    if (!words_.Is(i, TokenKind::kName)) return i + 1;
    const std::string name = words_.Lower(i);
    if (name == "jointtarget" || name == "robtarget") return ReadDeclaration(i, name);
    if (Has(kJointMotions, name)) return ReadMotion(i);
    if (Has(kPoseMotions, name)) findings_.PassThrough(words_.Line(i), kPoseMotion);
    if (words_.IsSign(BehindIndex(Next(i)), ":=") && !IsPart(i)) return ReadValue(i);
    findings_.AddOtherUse(name, words_.Line(i));
    return i + 1;
  }

  // A list in a call that is no joint motion, such as MoveExtJ or CalcRobT.
  size_t ReadList(size_t i) {
    size_t next = i;
    const auto list = ReadNumberList(words_, &next, Unit::kDegOrMm, false);
    if (!list.has_value()) return i + 1;
    if (MayBeJoints(*list)) findings_.PassThrough(words_.Line(i), kMayBeJoints);
    return next;
  }

  // x in r.x, and \ID of a call.
  bool IsPart(size_t i) const {
    return i > 0 && (words_.IsSign(i - 1, ".") || words_.IsSign(i - 1, "\\"));
  }

  // Behind `{...}` at `i`, or `i` when there is none.
  size_t BehindIndex(size_t i) const {
    if (!words_.IsSign(i, "{")) return i;
    size_t end = i;
    while (end < i + kLongestIndex && !words_.IsEnd(end) && !words_.IsSign(end, "}")) ++end;
    return words_.IsSign(end, "}") ? Next(end) : i;
  }

  // `jointtarget a{3}:=[...]`, `jointtarget a;`, `jointtarget a,` of a routine.
  size_t ReadDeclaration(size_t i, const std::string& type) {
    const size_t name = Next(i);
    const size_t behind = BehindIndex(Next(name));
    if (!words_.Is(name, TokenKind::kName)) return i + 1;
    if (!words_.IsSign(behind, ":=")) return behind;
    if (type == "jointtarget") return ReadValue(name);
    findings_.PassThrough(words_.Line(name), kRobtarget);
    return behind;
  }

  size_t ReadValue(size_t i) {
    const std::string name = words_.Lower(i);
    size_t next = Next(BehindIndex(Next(i)));
    const auto list = ReadNumberList(words_, &next, Unit::kDegOrMm, false);
    std::vector<JointTarget> targets;
    const bool whole = list.has_value() && words_.IsSign(words_.SkipLineEnds(next), ";") &&
                       Collect(*list, words_.Text(i), &targets);
    if (!declared_.contains(name)) {
      if (whole || (list.has_value() && MayBeJoints(*list)))
        findings_.PassThrough(words_.Line(i), NotDeclared(i));
    } else if (!whole) {
      PassValueThrough(name, words_.Line(i));
    }
    if (!whole || !declared_.contains(name)) return next;
    for (JointTarget& target : targets) findings_.AddValue(name, std::move(target), true);
    return next;
  }

  void PassValueThrough(const std::string& name, int line) {
    findings_.PassThrough(
        line, formats::StrCat(formats::Quoted(name), " gets a value that is no plain jointtarget"));
  }

  std::string NotDeclared(size_t i) const {
    return formats::StrCat("joint values for ", formats::Quoted(words_.Text(i)),
                           ", which this file does not declare as jointtarget");
  }

  size_t ReadMotion(size_t i) {
    size_t target = Next(i);
    if (words_.IsSign(target, "\\")) target = BehindSwitch(target);
    size_t next = target;
    const auto list = ReadNumberList(words_, &next, Unit::kDegOrMm, false);
    if (list.has_value() && IsJointTarget(*list) && EndsTarget(words_.SkipLineEnds(next))) {
      findings_.AddTarget(TargetOf(*list, words_.Text(i)));
      return next;
    }
    const size_t behind = BehindIndex(Next(target));
    if (words_.Is(target, TokenKind::kName) && EndsTarget(behind)) {
      findings_.AddMotion(words_.Lower(target), words_.Line(target));
      return behind;
    }
    findings_.PassThrough(words_.Line(i),
                          formats::StrCat(words_.Text(i), ": its target is no plain jointtarget"));
    return next;
  }

  // `\Conc,`
  size_t BehindSwitch(size_t i) const {
    const size_t comma = Next(Next(i));
    return words_.IsSign(comma, ",") ? Next(comma) : i;
  }

  bool EndsTarget(size_t i) const { return words_.IsSign(i, ",") || words_.IsSign(i, "\\"); }

  const Words words_;
  std::unordered_set<std::string> declared_;
  Findings findings_;
};

}  // namespace

Program ReadRapid(std::string_view text) { return Reader(text).Read(); }

}  // namespace truepose::programs
