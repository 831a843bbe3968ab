// What a create or update of any kind of resource is given on the command line.
#pragma once

#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/cli/command_line.h"
#include "client/cli/resource_kind.h"
#include "formats/message_file.h"

namespace truepose::cli {

struct ContentOptions {
  std::string file;
  std::vector<std::string> set;  // KEY=VALUE
  std::string features;          // a fixture file, of fixtures only
  std::string poses;             // a CSV of joints, of pose sets only
  std::string table_spec;        // a file, of robots only
};

// Describes the options that the kind has.
void AddContentOptions(const Command& command, const ResourceKind& kind, ContentOptions* options);

// What --help says of the keys.
std::string KeysFooter(const ResourceKind& kind);

// Fills `content` and tells which fields were given; the file first, then the options over it. What
// only the server sets may stand in a file, such as one of `show --json`, and does not count; its
// etag stays in `content`.
// @param name of the resource, whose robot tells what a CSV of joints means.
// @returns every fault of a file, or of --set, with file and line or key; a UsageError when nothing
//   is given and `needed`.
absl::Status ReadContent(const client::Client& client, const ResourceKind& kind,
                         const std::string& name, const ContentOptions& options, bool needed,
                         google::protobuf::Message& content, formats::GivenFields& given);

}  // namespace truepose::cli
