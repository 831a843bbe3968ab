#include "server/resource/resource_name.h"

#include <vector>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "server/store/names.h"

namespace truepose::resource {
namespace {

std::string FormOf(const ResourceType& type) {
  const std::string id = type.uuid_ids ? "{uuid}" : "{id}";
  return absl::StrCat(type.of_robot ? "robots/{robot}/" : "", type.collection, "/", id);
}

absl::Status CheckId(const ResourceType& type, const std::string& id, const std::string& field) {
  return type.uuid_ids ? store::CheckUuid(id, field) : store::CheckRobotId(id, field);
}

}  // namespace

std::string ToName(const ResourceType& type, const store::ResourceKey& key) {
  return absl::StrCat(type.of_robot ? absl::StrCat(store::RobotName(key.robot_id), "/") : "",
                      type.collection, "/", key.id);
}

absl::StatusOr<store::ResourceKey> ParseName(const ResourceType& type, const std::string& name,
                                             const std::string& field) {
  const std::vector<std::string> parts = absl::StrSplit(name, '/');
  const size_t at = type.of_robot ? 2 : 0;  // of the collection
  const bool has_form = parts.size() == at + 2 && parts[at] == type.collection &&
                        (!type.of_robot || parts[0] == "robots");
  store::ResourceKey key{.kind = type.kind, .robot_id = "", .id = ""};
  if (has_form) {
    key.id = parts[at + 1];
    if (type.of_robot) key.robot_id = parts[1];
  }
  const bool good = has_form && CheckId(type, key.id, field).ok() &&
                    (!type.of_robot || store::CheckRobotId(key.robot_id, field).ok());
  if (good) return key;
  return FaultStatus(field, absl::StrCat("'", name, "'"), FormOf(type));
}

absl::StatusOr<store::ResourceKey> MakeKey(const ResourceType& type, const std::string& parent,
                                           const std::string& id, const std::string& id_field) {
  FaultList faults;
  store::ResourceKey key{.kind = type.kind, .robot_id = "", .id = id};
  faults.AddAll(CheckId(type, id, id_field));
  if (type.of_robot) {
    const absl::StatusOr<std::string> robot = store::ParseRobotName(parent, "parent");
    faults.AddAll(robot.status());
    if (robot.ok()) key.robot_id = *robot;
  }
  if (!faults.empty()) return faults.ToStatus();
  return key;
}

}  // namespace truepose::resource
