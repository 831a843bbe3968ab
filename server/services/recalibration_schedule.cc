#include "server/services/recalibration_schedule.h"

#include <optional>
#include <string>
#include <vector>

#include "server/resource/resource_name.h"
#include "server/services/poses_to_measure.h"
#include "server/services/recalibration_causes.h"
#include "server/services/recalibration_requests.h"
#include "server/services/recalibration_rules.h"
#include "server/services/stored_resources.h"

namespace truepose::services {
namespace {

using store::Snapshot;
using store::Transaction;
using Raised = std::optional<v1::RecalibrationRequest>;

// Names of the open T of the plant for which `is_due(snapshot, item)`. Page by page, so that no
// look holds its snapshot for long.
template <typename T, typename IsDue>
absl::StatusOr<std::vector<std::string>> NamesOfDue(store::Store& store, IsDue is_due,
                                                    const IsStopping& is_stopping) {
  constexpr int kPage = 100;
  std::vector<std::string> names;
  std::string token;
  do {
    std::string next = token;
    TRUEPOSE_ASSIGN_OR_RETURN(
        const std::vector<std::string> due,
        store.Read([&](Snapshot& snapshot) -> absl::StatusOr<std::vector<std::string>> {
          next = token;
          std::vector<std::string> found;
          TRUEPOSE_ASSIGN_OR_RETURN(const auto page,
                                    PageOfResources<T>(snapshot, "", kPage, next, true));
          for (const T& item : page) {
            TRUEPOSE_ASSIGN_OR_RETURN(const bool taken, is_due(snapshot, item));
            if (taken) found.push_back(item.name());
          }
          return found;
        }));
    names.insert(names.end(), due.begin(), due.end());
    token = next;
  } while (!token.empty() && !is_stopping());
  return names;
}

// Does `act` for each name. @returns how often it answered true, or the first error.
template <typename Act>
absl::StatusOr<int> ForEach(const std::vector<std::string>& names, const IsStopping& is_stopping,
                            Act act) {
  absl::Status first;
  int count = 0;
  for (const std::string& name : names) {
    if (is_stopping()) break;
    const absl::StatusOr<bool> acted = act(name);
    first.Update(acted.status());
    count += acted.value_or(false) ? 1 : 0;
  }
  if (!first.ok()) return first;
  return count;
}

absl::StatusOr<Raised> RaiseOfPolicy(Transaction& transaction, const std::string& name,
                                     const PosesToMeasure* poses) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto policy,
                            GetLiveResource<v1::RecalibrationPolicy>(transaction, name, "name"));
  TRUEPOSE_ASSIGN_OR_RETURN(const auto cause,
                            CauseOfInterval(transaction, policy, transaction.now()));
  if (!cause.has_value()) return Raised();
  return RaiseOrNote(transaction, *cause, poses);
}

bool IsExpired(const v1::RecalibrationRequest& request, absl::Time now) {
  return IsOpen(request.state()) && store::ToTime(request.expire_time()) <= now;
}

// A request that was over before the store knew which are open.
absl::StatusOr<bool> Close(Transaction& transaction, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(const store::ResourceKey key,
                            resource::ParseName(TypeOf<v1::RecalibrationRequest>(), name, "name"));
  TRUEPOSE_RETURN_IF_ERROR(store::CloseResource(transaction, key));
  return false;
}

absl::StatusOr<bool> Expire(Transaction& transaction, const std::string& name) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto request, GetResource<v1::RecalibrationRequest>(transaction, name));
  if (!IsOpen(request.state())) return Close(transaction, name);
  if (!IsExpired(request, transaction.now())) return false;
  TRUEPOSE_RETURN_IF_ERROR(AppendStep(transaction, v1::REQUEST_EXPIRED, kServerPrincipal,
                                      "nobody finished it in time", request));
  return true;
}

}  // namespace

absl::StatusOr<int> RaiseDueRequests(store::Store& store, const IsStopping& is_stopping) {
  const absl::Time now = store.clock().Now();
  const auto is_due = [now](Snapshot& snapshot,
                            const v1::RecalibrationPolicy& policy) -> absl::StatusOr<bool> {
    TRUEPOSE_ASSIGN_OR_RETURN(const auto cause, CauseOfInterval(snapshot, policy, now));
    return cause.has_value();
  };
  TRUEPOSE_ASSIGN_OR_RETURN(const auto names,
                            NamesOfDue<v1::RecalibrationPolicy>(store, is_due, is_stopping));
  return ForEach(names, is_stopping, [&](const std::string& name) -> absl::StatusOr<bool> {
    const std::string robot = name.substr(0, name.find("/recalibrationPolicies/"));
    TRUEPOSE_ASSIGN_OR_RETURN(
        const Raised raised, WithPoses(store, robot, [&](const PosesToMeasure* poses) {
          return store.Write(
              [&](Transaction& transaction) { return RaiseOfPolicy(transaction, name, poses); });
        }));
    return raised.has_value();
  });
}

absl::StatusOr<int> ExpireRequests(store::Store& store, const IsStopping& is_stopping) {
  const absl::Time now = store.clock().Now();
  const auto is_due = [now](Snapshot&, const v1::RecalibrationRequest& request) {
    return absl::StatusOr<bool>(IsExpired(request, now) || !IsOpen(request.state()));
  };
  TRUEPOSE_ASSIGN_OR_RETURN(const auto names,
                            NamesOfDue<v1::RecalibrationRequest>(store, is_due, is_stopping));
  return ForEach(names, is_stopping, [&](const std::string& name) {
    return store.Write([&](Transaction& transaction) { return Expire(transaction, name); });
  });
}

}  // namespace truepose::services
