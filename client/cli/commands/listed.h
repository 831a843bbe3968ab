// Lists whose table is their own: all pages in one response, with what every list takes.
#pragma once

#include "absl/status/statusor.h"
#include "client/cli/commands/list_options.h"
#include "client/cli/names.h"
#include "client/cli/remote.h"
#include "client/cli/reply.h"
#include "client/pager.h"
#include "core/base/status_macros.h"

namespace truepose::cli {

// @param call such as &client::Client::ListDriftChecks.
template <typename Request, typename Response>
absl::StatusOr<Response> AllPages(const client::Client& client, const ListOptions& options,
                                  absl::StatusOr<Response> (client::Client::*call)(const Request&)
                                      const) {
  Request first;
  if constexpr (requires { first.set_parent(""); }) first.set_parent(RobotName(options.robot));
  SetListOptions(options, first);
  Response all;
  TRUEPOSE_RETURN_IF_ERROR(AsListed(client::ForEachPage(
      first, [&](const Request& request) { return (client.*call)(request); },
      [&](const Response& page) {
        all.MergeFrom(page);
        return absl::OkStatus();
      })));
  all.clear_next_page_token();
  return all;
}

template <typename Request, typename Response>
absl::Status ReplyAllPages(const Invocation& invocation, const ListOptions& options,
                           absl::StatusOr<Response> (client::Client::*call)(const Request&) const,
                           std::string (*table)(const Response&)) {
  return WithServer(invocation, kRobotHint, [&](const client::Client& client) -> absl::Status {
    TRUEPOSE_ASSIGN_OR_RETURN(const Response all, AllPages(client, options, call));
    return Reply(invocation, all, [&] { return table(all); });
  });
}

}  // namespace truepose::cli
