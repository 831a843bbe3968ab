// Pages of a list. A token is opaque, belongs to one list with one filter, and stays valid while
// things are added: it names the last item that was returned, not a position.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "absl/status/statusor.h"

namespace truepose::store {

struct PageRequest {
  int size = 0;       // 0 = the list's default; more than its maximum = the maximum; negative is
                      // kInvalidArgument
  std::string token;  // "" = from the start
};

template <typename T>
struct Page {
  std::vector<T> items;
  std::string next_page_token;  // "" = this was the last
};

struct PageLimits {
  int default_size = 100;
  int max_size = 1000;
};

// What a token is bound to: the list's name and its filter, such as "jobs" and "ur10".
struct ListId {
  std::string list;
  std::string filter;
};

// A request after its checks: how many, and after which key ("" = from the start).
struct PageStart {
  int size;
  std::string after;
};

// @returns kInvalidArgument with every fault (fields `page_size`, `page_token`).
absl::StatusOr<PageStart> CheckPage(const ListId& id, const PageRequest& request,
                                    const PageLimits& limits = {});
// The same for lists whose key is a number; `none` is returned for the first page.
absl::StatusOr<int64_t> AfterNumber(const PageStart& start, int64_t none);

std::string MakePageToken(const ListId& id, std::string_view last_key);

}  // namespace truepose::store
