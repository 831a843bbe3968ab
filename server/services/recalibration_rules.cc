#include "server/services/recalibration_rules.h"

#include <vector>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/strip.h"
#include "server/store/message.h"
#include "server/store/open_request.h"

namespace truepose::services {
namespace {

struct Way {
  v1::RecalibrationState from, to;
};

// What callers do; the ways of jobs are in the header.
constexpr Way kWays[] = {
    {v1::REQUEST_PENDING, v1::REQUEST_ACKNOWLEDGED},
    {v1::REQUEST_ACKNOWLEDGED, v1::REQUEST_MEASURING},
    {v1::REQUEST_MEASURING, v1::REQUEST_MEASURING},
    {v1::REQUEST_MEASURING, v1::REQUEST_CALIBRATING},
};

bool EndsByHand(v1::RecalibrationState to) {
  return to == v1::REQUEST_DECLINED || to == v1::REQUEST_EXPIRED;
}

bool MayFollow(v1::RecalibrationState from, v1::RecalibrationState to) {
  if (EndsByHand(to)) return IsOpen(from);
  for (const Way& way : kWays)
    if (way.from == from && way.to == to) return true;
  return false;
}

// REQUEST_PENDING -> "pending", as people read it.
std::string Word(v1::RecalibrationState state) {
  return absl::AsciiStrToLower(absl::StripPrefix(v1::RecalibrationState_Name(state), "REQUEST_"));
}

// States that fit: "pending or acknowledged".
template <typename Fits>
std::string Named(Fits fits) {
  std::vector<std::string> names;
  for (int i = v1::RecalibrationState_MIN; i <= v1::RecalibrationState_MAX; ++i) {
    const auto state = static_cast<v1::RecalibrationState>(i);
    if (fits(state)) names.push_back(Word(state));
  }
  return names.empty() ? "none, it has ended" : absl::StrJoin(names, " or ");
}

}  // namespace

bool IsOpen(v1::RecalibrationState state) { return store::IsOpen(state); }

absl::Status CheckStep(const v1::RecalibrationRequest& request, v1::RecalibrationState to) {
  const v1::RecalibrationState from = request.state();
  if (MayFollow(from, to)) return absl::OkStatus();
  const std::string before = Named([to](auto state) { return MayFollow(state, to); });
  const std::string after = Named([from](auto state) { return MayFollow(from, state); });
  return store::Refusal(
      absl::StatusCode::kFailedPrecondition, "name",
      absl::StrCat(request.name(), ", which is ", Word(from)),
      absl::StrCat("one that is ", before, "; what may follow ", Word(from), ": ", after));
}

}  // namespace truepose::services
