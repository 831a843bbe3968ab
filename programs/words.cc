#include "programs/words.h"

#include "absl/strings/ascii.h"
#include "formats/number.h"

namespace truepose::programs {

bool Words::IsSign(size_t i, std::string_view sign) const {
  return At(i).kind == TokenKind::kSign && Text(i) == sign;
}

std::string_view Words::Text(size_t i) const {
  return text_.substr(At(i).begin, At(i).end - At(i).begin);
}

std::string Words::Lower(size_t i) const {
  std::string text(Text(i));
  absl::AsciiStrToLower(&text);
  return text;
}

size_t Words::SkipLineEnds(size_t i) const {
  while (Is(i, TokenKind::kLineEnd)) ++i;
  return i;
}

std::optional<JointNumber> Words::ReadNumber(size_t* i, Unit unit) const {
  const bool minus = IsSign(*i, "-");
  const size_t number = *i + (minus || IsSign(*i, "+"));
  if (!Is(number, TokenKind::kNumber)) return std::nullopt;
  // A comment between the two would be lost with the sign.
  const std::string_view gap = text_.substr(At(*i).end, At(number).begin - At(*i).end);
  if (number != *i && gap.find_first_not_of(" \t") != std::string_view::npos) return std::nullopt;
  const std::optional<double> value = formats::ParseNumber(Text(number));
  if (!value.has_value()) return std::nullopt;
  const JointNumber result{At(*i).begin, At(number).end, minus ? -*value : *value, unit};
  *i = number + 1;
  return result;
}

}  // namespace truepose::programs
