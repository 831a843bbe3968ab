#include "client/agent/sources.h"

#include "client/agent/log.h"
#include "client/agent/sources/configured.h"
#include "core/base/status_macros.h"

namespace truepose::agent {

absl::StatusOr<std::vector<std::unique_ptr<Source>>> MakeSources(
    const std::vector<SourceSettings>& settings) {
  const FaultReport report = [](const Fault& fault) { LogWarning(ToString(fault)); };
  std::vector<std::unique_ptr<Source>> sources;
  FaultList faults;
  for (const SourceSettings& one : settings) {
    auto source = MakeSource(one, report);
    faults.AddAll(source.status(), one.place);
    if (source.ok()) sources.push_back(*std::move(source));
  }
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return sources;
}

}  // namespace truepose::agent
