#include "client/agent/sources.h"

#include <functional>
#include <map>
#include <string>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

using Make = std::function<absl::StatusOr<std::unique_ptr<Source>>(const SourceSettings&)>;

// Word in the configuration -> what makes the source.
const std::map<std::string, Make>& Kinds() {
  static const auto& kinds = *new std::map<std::string, Make>{};
  return kinds;
}

std::string KnownKinds() {
  std::string names;
  for (const auto& [name, make] : Kinds()) absl::StrAppend(&names, names.empty() ? "" : ", ", name);
  return names.empty() ? "no source: this program takes readings by its TCP interface" : names;
}

}  // namespace

absl::StatusOr<std::vector<std::unique_ptr<Source>>> MakeSources(
    const std::vector<SourceSettings>& settings) {
  std::vector<std::unique_ptr<Source>> sources;
  FaultList faults;
  for (const SourceSettings& one : settings) {
    const auto kind = Kinds().find(one.kind);
    if (kind == Kinds().end()) {
      faults.Add(one.place + "kind", absl::StrCat("'", one.kind, "'"), KnownKinds());
      continue;
    }
    auto source = kind->second(one);
    faults.AddAll(source.status(), one.place);
    if (source.ok()) sources.push_back(*std::move(source));
  }
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return sources;
}

}  // namespace truepose::agent
