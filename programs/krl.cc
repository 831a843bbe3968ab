#include "programs/krl.h"

#include <algorithm>
#include <array>
#include <utility>

#include "formats/strings.h"
#include "formats/wording.h"
#include "programs/findings.h"
#include "programs/krl_aggregate.h"

namespace truepose::programs {
namespace {

using Kind = KrlAggregate::Kind;

constexpr int kAxesOfKrl = 6;

constexpr std::array<std::string_view, 7> kMotions = {"ptp",  "sptp",  "lin", "slin",
                                                      "circ", "scirc", "spl"};
constexpr std::array<std::string_view, 7> kRelative = {
    "ptp_rel", "sptp_rel", "lin_rel", "slin_rel", "circ_rel", "scirc_rel", "spl_rel"};

constexpr char kPose[] =
    "a pose: the controller finds its joints by its own kinematics, so it is not corrected";

template <class List>
bool Has(const List& list, std::string_view word) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

class Reader {
 public:
  Reader(std::string_view text, int joints)
      : words_(text, {.comment = ';', .header = '&', .name_marks = "$"}), joints_(joints) {}

  Program Read() {
    for (size_t i = 0; !words_.IsEnd(i);) i = ReadLine(i);
    return std::move(findings_).Finish();
  }

 private:
  // @returns the place of the next line's first word.
  size_t ReadLine(size_t i) {
    const std::string first = words_.Lower(i);
    if (Has(kRelative, first))
      findings_.PassThrough(words_.Line(i), "a relative motion: not corrected");
    if (Has(kMotions, first)) {
      i = ReadMotion(i);
    } else if (const size_t name = NameOfDeclaration(i); name > i) {
      i = ReadDeclaration(name);
    } else if (const size_t equals = AssignedAt(i); equals > 0) {
      i = ReadValue(i, equals);
    }
    while (!words_.EndsLine(i)) i = ReadOther(i);
    return words_.IsEnd(i) ? i : i + 1;
  }

  size_t ReadMotion(size_t i) {
    const size_t target = i + 1;
    if (words_.IsSign(target, "{")) {
      return ReadAggregate(target, [&](JointTarget joints) {
        joints.what = std::string(words_.Text(i));
        findings_.AddTarget(std::move(joints));
      });
    }
    const size_t behind = BehindIndex(target + 1);
    if (words_.Is(target, TokenKind::kName) && EndsTarget(behind)) {
      findings_.AddMotion(words_.Lower(target), words_.Line(target));
      return behind;
    }
    findings_.PassThrough(words_.Line(i),
                          formats::StrCat(words_.Text(i), ": its target is calculated"));
    return target;
  }

  // What may follow a whole target: nothing, how to blend, or what only this motion has.
  bool EndsTarget(size_t i) const {
    return words_.EndsLine(i) || words_.IsSign(i, ",") || words_.Is(i, TokenKind::kName);
  }

  // Behind `[...]` at `i`, or `i` when there is none.
  size_t BehindIndex(size_t i) const {
    if (!words_.IsSign(i, "[")) return i;
    size_t end = i;
    while (!words_.EndsLine(end) && !words_.IsSign(end, "]")) ++end;
    return words_.EndsLine(end) ? i : end + 1;
  }

  // Place of the name in `DECL GLOBAL E6AXIS XP1`, or `i` for anything that declares no joints.
  size_t NameOfDeclaration(size_t i) const {
    size_t type = i;
    while (words_.Lower(type) == "decl" || words_.Lower(type) == "global" ||
           words_.Lower(type) == "const") {
      ++type;
    }
    const std::string name = words_.Lower(type);
    const bool axes = name == "e6axis" || name == "axis";
    return axes && words_.Is(type + 1, TokenKind::kName) ? type + 1 : i;
  }

  // `E6AXIS XP1, XP2` only says that they are there.
  size_t ReadDeclaration(size_t name) {
    const size_t equals = AssignedAt(name);
    if (equals > 0) return ReadValue(name, equals);
    while (!words_.EndsLine(name)) ++name;
    return name;
  }

  // Place of the = behind a name, with an index or without; 0 when there is none.
  size_t AssignedAt(size_t i) const {
    if (!words_.Is(i, TokenKind::kName)) return 0;
    const size_t equals = BehindIndex(i + 1);
    return words_.IsSign(equals, "=") ? equals : 0;
  }

  size_t ReadValue(size_t place, size_t equals) {
    const std::string name = words_.Lower(place);
    if (!words_.IsSign(equals + 1, "{")) {
      findings_.AddOtherValue(name, words_.Line(equals));
      return equals + 1;
    }
    return ReadAggregate(equals + 1, [&](JointTarget joints) {
      joints.what = std::string(words_.Text(place));
      if (!name.starts_with("$")) return findings_.AddValue(name, std::move(joints), true);
      findings_.PassThrough(joints.line,
                            formats::StrCat(formats::Quoted(name), " is a system variable"));
    });
  }

  // Hands whole axes to `take`, lists what else concerns joints or poses.
  template <class Take>
  size_t ReadAggregate(size_t i, Take take) {
    KrlAggregate aggregate = ReadKrlAggregate(words_, i);
    const int line = words_.Line(i);
    if (aggregate.kind == Kind::kPose) findings_.PassThrough(line, kPose);
    if (aggregate.kind == Kind::kUnclear)
      findings_.PassThrough(line, "its axes are no plain numbers");
    if (aggregate.kind == Kind::kPartly || LeavesOutAxes(aggregate)) {
      findings_.PassThrough(line, "leaves out axes, which stay where they are at run time");
    } else if (aggregate.kind == Kind::kAxes) {
      take({line, "", std::move(aggregate.axes)});
      return aggregate.end;
    }
    if (aggregate.kind == Kind::kUnclear) AddUses(i, aggregate.end);
    return aggregate.end;
  }

  void AddUses(size_t i, size_t end) {
    for (; i < end; ++i) {
      if (words_.Is(i, TokenKind::kName)) findings_.AddOtherUse(words_.Lower(i), words_.Line(i));
    }
  }

  bool LeavesOutAxes(const KrlAggregate& aggregate) const {
    const int axes = static_cast<int>(aggregate.axes.size());
    return aggregate.kind == Kind::kAxes && axes < std::min(joints_, kAxesOfKrl);
  }

  // Somewhere in a line that is not understood.
  size_t ReadOther(size_t i) {
    if (words_.IsSign(i, "{")) {
      return ReadAggregate(i, [&](const JointTarget& joints) {
        findings_.PassThrough(joints.line, "joint values where no target is expected");
      });
    }
    if (words_.Is(i, TokenKind::kUnclear) && words_.Text(i).front() == '"')
      findings_.PassThrough(words_.Line(i), "a text without an end: the rest is not read");
    if (words_.Is(i, TokenKind::kName)) findings_.AddOtherUse(words_.Lower(i), words_.Line(i));
    return i + 1;
  }

  const Words words_;
  const int joints_;
  Findings findings_;
};

}  // namespace

Program ReadKrl(std::string_view text, int joints) { return Reader(text, joints).Read(); }

}  // namespace truepose::programs
