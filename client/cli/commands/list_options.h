// What every list takes.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "client/cli/command_line.h"

namespace truepose::cli {

struct ListOptions {
  std::string robot, filter;
  bool show_deleted = false;
};

// --robot, --filter and --show-deleted, as far as the list has them.
// @param example of a filter: state = "SEALED".
struct ListHas {
  bool robot = false;
  bool deleted = false;
  std::string example;
};
void AddListOptions(const Command& command, const ListHas& has, ListOptions* options);

// Into the fields of a List request that has them.
template <typename Request>
void SetListOptions(const ListOptions& options, Request& request) {
  request.set_filter(options.filter);
  if constexpr (requires { request.set_show_deleted(true); }) {
    request.set_show_deleted(options.show_deleted);
  }
}

// Faults in the words of the command line.
absl::Status AsListed(const absl::Status& status);

}  // namespace truepose::cli
