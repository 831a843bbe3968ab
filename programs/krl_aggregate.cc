#include "programs/krl_aggregate.h"

#include <algorithm>
#include <array>
#include <optional>

namespace truepose::programs {
namespace {

constexpr int kMostAxes = 12;

// 1 for "a1"; 0 for what names no robot axis.
int AxisNamed(const std::string& name) {
  if (name.size() < 2 || name.size() > 3 || name[0] != 'a' || name[1] == '0') return 0;
  int axis = 0;
  for (const char c : name.substr(1)) {
    if (c < '0' || c > '9') return 0;
    axis = 10 * axis + (c - '0');
  }
  return axis <= kMostAxes ? axis : 0;
}

bool IsPoseName(const std::string& name) {
  return name.size() == 1 && std::string("xyzabc").find(name) != std::string::npos;
}

class AggregateReader {
 public:
  AggregateReader(const Words& words, size_t i) : words_(words), i_(i + 1) {}

  KrlAggregate Read() {
    if (words_.Is(i_, TokenKind::kName) && words_.IsSign(i_ + 1, ":")) i_ += 2;
    while (ReadComponent() && words_.IsSign(i_, ",")) ++i_;
    const bool closed = words_.IsSign(i_, "}");
    KrlAggregate result;
    result.kind = KindOf(closed);
    result.end = i_ + closed;
    if (result.kind == KrlAggregate::Kind::kAxes) {
      for (int k = 0; k < highest_; ++k) result.axes.push_back(*axes_[k]);
    }
    return result;
  }

 private:
  // A name and what follows it up to the next comma or bracket.
  // @returns false at the line's end.
  bool ReadComponent() {
    const std::string name = words_.Lower(i_);
    const int axis = words_.Is(i_, TokenKind::kName) ? AxisNamed(name) : 0;
    pose_ = pose_ || (words_.Is(i_, TokenKind::kName) && IsPoseName(name));
    if (!words_.EndsLine(i_)) ++i_;
    if (axis > 0) ReadAxis(axis);
    return SkipToSeparator();
  }

  void ReadAxis(int axis) {
    named_ = true;
    const auto number = words_.ReadNumber(&i_, Unit::kDegOrMm);
    const bool whole = words_.IsSign(i_, ",") || words_.IsSign(i_, "}");
    if (!number.has_value() || !whole || axes_[axis - 1].has_value()) {
      unclear_ = true;
      return;
    }
    axes_[axis - 1] = number;
    highest_ = std::max(highest_, axis);
    ++count_;
  }

  bool SkipToSeparator() {
    int depth = 0;
    for (; !words_.EndsLine(i_); ++i_) {
      if (depth == 0 && (words_.IsSign(i_, ",") || words_.IsSign(i_, "}"))) return true;
      depth += words_.IsSign(i_, "{") || words_.IsSign(i_, "[") || words_.IsSign(i_, "(");
      depth -= words_.IsSign(i_, "}") || words_.IsSign(i_, "]") || words_.IsSign(i_, ")");
    }
    return false;
  }

  KrlAggregate::Kind KindOf(bool closed) const {
    if (!named_) return pose_ ? KrlAggregate::Kind::kPose : KrlAggregate::Kind::kOther;
    if (unclear_ || pose_ || !closed) return KrlAggregate::Kind::kUnclear;
    return count_ == highest_ ? KrlAggregate::Kind::kAxes : KrlAggregate::Kind::kPartly;
  }

  const Words& words_;
  size_t i_;
  std::array<std::optional<JointNumber>, kMostAxes> axes_;
  int highest_ = 0, count_ = 0;
  bool named_ = false, unclear_ = false, pose_ = false;
};

}  // namespace

KrlAggregate ReadKrlAggregate(const Words& words, size_t i) {
  return AggregateReader(words, i).Read();
}

}  // namespace truepose::programs
