// Resources of a robot as their own messages, for handlers that know the kind.
#pragma once

#include <string>
#include <vector>

#include "absl/status/statusor.h"
#include "core/base/status_macros.h"
#include "server/resource/registry.h"
#include "server/resource/standard_fields.h"
#include "server/resource/standard_methods.h"
#include "server/store/message.h"

namespace truepose::services {

template <typename T>
const resource::ResourceType& TypeOf() {
  return *resource::FindType(T::descriptor());
}

// Also a deleted one. @returns kInvalidArgument for the form of the name, kNotFound; both with a
// fault of `field`.
template <typename T>
absl::StatusOr<T> GetResource(store::Snapshot& snapshot, const std::string& name,
                              const std::string& field = "name") {
  T found;
  TRUEPOSE_RETURN_IF_ERROR(resource::Get(snapshot, TypeOf<T>(), name, field, found));
  return found;
}

// The same for one that is not deleted.
template <typename T>
absl::StatusOr<T> GetLiveResource(store::Snapshot& snapshot, const std::string& name,
                                  const std::string& field) {
  TRUEPOSE_ASSIGN_OR_RETURN(T found, GetResource<T>(snapshot, name, field));
  if (resource::IsDeleted(found)) return store::NotFound(name, field);
  return found;
}

// One page of those that are not deleted, with `show_deleted` of all, oldest first; `robot` = "" is
// of all robots. `token` is that of the page, and then that of the next one.
template <typename T>
absl::StatusOr<std::vector<T>> PageOfResources(store::Snapshot& snapshot, const std::string& robot,
                                               int size, std::string& token, bool only_open = false,
                                               bool show_deleted = false) {
  std::vector<std::unique_ptr<T>> items;
  const resource::ListAsked asked{.parent = robot,
                                  .page = {size, token},
                                  .filter = "",
                                  .show_deleted = show_deleted,
                                  .only_open = only_open};
  TRUEPOSE_ASSIGN_OR_RETURN(token, resource::List(snapshot, TypeOf<T>(), asked, [&] {
                              return items.emplace_back(std::make_unique<T>()).get();
                            }));
  std::vector<T> page;
  for (const std::unique_ptr<T>& item : items) page.push_back(std::move(*item));
  return page;
}

// All of a robot. @param only_open those that time alone may change; no others are read.
// @param show_deleted those that are deleted, too.
template <typename T>
absl::StatusOr<std::vector<T>> AllOfRobot(store::Snapshot& snapshot, const std::string& robot,
                                          bool only_open = false, bool show_deleted = false) {
  constexpr int kPage = 1'000;
  std::vector<T> all;
  std::string token;
  do {
    TRUEPOSE_ASSIGN_OR_RETURN(std::vector<T> page, PageOfResources<T>(snapshot, robot, kPage, token,
                                                                      only_open, show_deleted));
    for (T& item : page) all.push_back(std::move(item));
  } while (!token.empty());
  return all;
}

}  // namespace truepose::services
