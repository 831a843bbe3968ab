// Walks all pages of a List call.
#pragma once

#include <string>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"

namespace truepose::client {

// Calls `list(request)` page by page and hands each reply to `on_page`, which returns an
// absl::Status and ends the walk when that is not OK. A server that answers with the token it was
// given would keep us forever: kInternal.
//   ForEachPage(v1::ListRobotsRequest(), [&](const auto& r) { return client.ListRobots(r); },
//               [&](const v1::ListRobotsResponse& page) { ...; return absl::OkStatus(); });
template <typename Request, typename List, typename OnPage>
absl::Status ForEachPage(Request request, const List& list, const OnPage& on_page) {
  while (true) {
    auto page = list(request);
    if (!page.ok()) return page.status();
    if (absl::Status status = on_page(*page); !status.ok()) return status;
    if (page->next_page_token().empty()) return absl::OkStatus();
    if (page->next_page_token() == request.page_token()) {
      return absl::InternalError("the server answered with the page token it was given");
    }
    request.set_page_token(page->next_page_token());
  }
}

}  // namespace truepose::client
