#include "server/store/page.h"

#include <algorithm>

#include "absl/strings/escaping.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/base/fault.h"

namespace truepose::store {
namespace {

// Tells a token of ours from other base64, and later forms from this one.
constexpr char kForm[] = "page1";

// The last key of a token; nothing when it isn't one of this list.
bool ParseToken(const ListId& id, const std::string& token, std::string& key) {
  std::string plain;
  if (!absl::WebSafeBase64Unescape(token, &plain)) return false;
  const std::vector<std::string> parts = absl::StrSplit(plain, '\n');
  if (parts.size() != 4 || parts[0] != kForm || parts[1] != id.list || parts[2] != id.filter)
    return false;
  key = parts[3];
  return !key.empty();
}

}  // namespace

std::string MakePageToken(const ListId& id, std::string_view last_key) {
  return absl::WebSafeBase64Escape(
      absl::StrCat(kForm, "\n", id.list, "\n", id.filter, "\n", std::string(last_key)));
}

absl::StatusOr<PageStart> CheckPage(const ListId& id, const PageRequest& request,
                                    const PageLimits& limits) {
  FaultList faults;
  PageStart start;
  start.size = request.size == 0 ? limits.default_size : std::min(request.size, limits.max_size);
  if (request.size < 0) faults.Add("page_size", absl::StrCat(request.size), "0 or more");
  if (!request.token.empty() && !ParseToken(id, request.token, start.after)) {
    faults.Add("page_token", absl::StrCat("'", request.token, "'"),
               "a next_page_token of this list with this filter");
  }
  if (!faults.empty()) return faults.ToStatus();
  return start;
}

absl::StatusOr<int64_t> AfterNumber(const PageStart& start, int64_t none) {
  int64_t number = none;
  if (start.after.empty() || absl::SimpleAtoi(start.after, &number)) return number;
  return FaultStatus("page_token", absl::StrCat("the key '", start.after, "'"),
                     "a next_page_token of this list");
}

}  // namespace truepose::store
