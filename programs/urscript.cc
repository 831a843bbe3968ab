#include "programs/urscript.h"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/strings.h"
#include "programs/findings.h"
#include "programs/number_list.h"

namespace truepose::programs {
namespace {

// Motions and how many of their first arguments are targets.
constexpr std::array<std::pair<std::string_view, int>, 6> kMotions = {
    {{"movej", 1}, {"movel", 1}, {"movep", 1}, {"movec", 2}, {"servoj", 1}, {"servoc", 1}}};

// Lists in them are speeds, forces and offsets, as those in calls of set_... are tools and loads.
constexpr std::array<std::string_view, 6> kNoTargets = {
    "speedj", "speedl", "force_mode", "direct_torque", "path_offset_set", "wrench_trans"};

constexpr size_t kJoints = 6;

constexpr char kMayBeJoints[] =
    "a list of numbers that may be joints, where no known motion has its target";
constexpr char kPose[] =
    "a pose: the controller finds its joints by its own kinematics, so it is not corrected";
constexpr char kNotPlain[] = "its target is no plain list of numbers";

// An argument longer than this is not looked through for its end.
constexpr size_t kLongestArgument = 10000;

// Whether it is, or holds, a list as long as one of joints.
bool MayBeJoints(const NumberNode& node) {
  if (node.IsFlat()) return node.items.size() >= kJoints;
  return std::any_of(node.items.begin(), node.items.end(), MayBeJoints);
}

class Reader {
 public:
  explicit Reader(std::string_view text)
      : words_(text, {.comment = '#', .name_marks = "", .backslash_unclear = true}) {}

  Program Read() {
    for (size_t i = 0; !words_.IsEnd(i);) i = ReadAt(i);
    return std::move(findings_).Finish();
  }

 private:
  // Each returns the place from which to go on, behind `i`.
  size_t ReadAt(size_t i) {
    if (words_.Is(i, TokenKind::kUnclear)) return ReadUnclear(i);
    if (words_.IsSign(i, "[")) return ReadList(i);
    if (!words_.Is(i, TokenKind::kName)) return i + 1;
    if (const int targets = TargetsOf(i); targets > 0) return ReadMotion(i, targets);
    if (IsCallWithoutTargets(i)) return SkipCall(i);
    if (IsPose(i)) return ReadPose(i);
    if (IsAssignment(i)) return ReadAssignment(i);
    findings_.AddOtherUse(std::string(words_.Text(i)), words_.Line(i));
    return i + 1;
  }

  size_t ReadUnclear(size_t i) {
    if (words_.Text(i).front() == '"') {
      findings_.PassThrough(words_.Line(i),
                            "a text whose end can't be told: the rest of the line is not read");
    }
    return i + 1;
  }

  int TargetsOf(size_t i) const {
    if (!words_.IsSign(i + 1, "(") || words_.IsSign(i - (i > 0), ".")) return 0;
    for (const auto& [name, targets] : kMotions) {
      if (name == words_.Text(i)) return targets;
    }
    return 0;
  }

  bool IsCallWithoutTargets(size_t i) const {
    if (!words_.IsSign(i + 1, "(") || words_.IsSign(i - (i > 0), ".")) return false;
    const std::string_view name = words_.Text(i);
    return name.starts_with("set_") ||
           std::find(kNoTargets.begin(), kNoTargets.end(), name) != kNoTargets.end();
  }

  // A list that is no motion's target, no variable's value and in no call that is known.
  size_t ReadList(size_t i) {
    size_t next = i;
    const auto list = ReadNumberList(words_, &next, Unit::kRadOrM, true);
    if (!list.has_value()) return i + 1;
    const bool is_pose = i > 0 && IsPose(i - 1);
    if (!is_pose && MayBeJoints(*list)) findings_.PassThrough(words_.Line(i), kMayBeJoints);
    return next;
  }

  // A tool's or load's pose is no target; names in there are uses as everywhere.
  size_t SkipCall(size_t i) {
    size_t end = ArgumentEnd(i + 2);
    while (words_.IsSign(end, ",")) end = ArgumentEnd(end + 1);
    for (size_t k = i + 2; k < end; ++k) {
      if (!IsPose(k)) ReadInExpression(k);
    }
    return end;
  }

  void ReadInExpression(size_t i) {
    if (words_.Is(i, TokenKind::kUnclear)) ReadUnclear(i);
    if (!words_.Is(i, TokenKind::kName)) return;
    if (IsPose(i)) {
      ReadPose(i);
    } else {
      findings_.AddOtherUse(std::string(words_.Text(i)), words_.Line(i));
    }
  }

  bool IsPose(size_t i) const { return words_.Text(i) == "p" && words_.IsSign(i + 1, "["); }

  size_t ReadPose(size_t i) {
    findings_.PassThrough(words_.Line(i), kPose);
    return i + 1;
  }

  bool IsStartOfStatement(size_t i) const {
    if (i == 0) return true;
    const std::string_view before = words_.Text(i - 1);
    return words_.Is(i - 1, TokenKind::kLineEnd) || before == ";" || before == "global" ||
           before == "local" || before == ":";
  }

  bool IsAssignment(size_t i) const {
    return IsStartOfStatement(i) && (words_.IsSign(i + 1, "=") || words_.IsSign(i + 1, ":="));
  }

  size_t ReadAssignment(size_t i) {
    const std::string name(words_.Text(i));
    size_t next = i + 2;
    const auto list = ReadNumberList(words_, &next, Unit::kRadOrM, true);
    if (list.has_value() && list->IsFlat() && (words_.EndsLine(next) || words_.IsSign(next, ";"))) {
      findings_.AddValue(name, {words_.Line(i), name, list->Numbers()}, false);
      return next;
    }
    if (!IsPose(i + 2)) findings_.AddOtherValue(name, words_.Line(i));
    return i + 2;
  }

  size_t ReadMotion(size_t i, int targets) {
    size_t next = i + 2;
    for (int k = 0; k < targets; ++k) {
      if (k > 0 && !words_.IsSign(next, ",")) return next;
      next = ReadArgument(i, next + (k > 0));
    }
    return next;
  }

  bool EndsArgument(size_t i) const {
    i = words_.SkipLineEnds(i);
    return words_.IsSign(i, ",") || words_.IsSign(i, ")");
  }

  // @param motion place of the motion's name.
  size_t ReadArgument(size_t motion, size_t i) {
    i = words_.SkipLineEnds(i);
    if (words_.Is(i, TokenKind::kName) && words_.IsSign(i + 1, "=")) i += 2;
    size_t next = i;
    const auto list = ReadNumberList(words_, &next, Unit::kRadOrM, true);
    if (list.has_value() && list->IsFlat() && EndsArgument(next)) {
      findings_.AddTarget({words_.Line(i), std::string(words_.Text(motion)), list->Numbers()});
      return next;
    }
    if (words_.Is(i, TokenKind::kName) && EndsArgument(i + 1)) {
      findings_.AddMotion(std::string(words_.Text(i)), words_.Line(i));
      return i + 1;
    }
    return ReadExpression(motion, i);
  }

  size_t ReadExpression(size_t motion, size_t i) {
    if (!IsPose(i)) {
      findings_.PassThrough(words_.Line(motion),
                            formats::StrCat(words_.Text(motion), ": ", kNotPlain));
    }
    const size_t end = ArgumentEnd(i);
    for (; i < end; ++i) ReadInExpression(i);
    return i;
  }

  // The comma or bracket that ends the argument that begins at `i`, or its line's end: the rest of
  // a calculation over several lines is read as statements, which finds the same uses.
  size_t ArgumentEnd(size_t i) const {
    int depth = 0;
    const size_t last = i + kLongestArgument;
    for (; i < last && !words_.EndsLine(i); ++i) {
      if (depth == 0 && EndsArgument(i)) return i;
      depth += IsBracket(i, "([{") - IsBracket(i, ")]}");
    }
    return i;
  }

  bool IsBracket(size_t i, std::string_view brackets) const {
    return words_.Is(i, TokenKind::kSign) &&
           brackets.find(words_.Text(i)) != std::string_view::npos;
  }

  const Words words_;
  Findings findings_;
};

}  // namespace

Program ReadUrScript(std::string_view text) { return Reader(text).Read(); }

}  // namespace truepose::programs
