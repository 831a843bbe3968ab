#include "client/cli/commands/table_names.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "client/cli/names.h"
#include "client/pager.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"

namespace truepose::cli {

const char kOneTable[] =
    "ROBOT: its active table; or ROBOT/UUID; or the first digits of its UUID or SHA-256";
const char kTableToChange[] =
    "ROBOT/UUID, or the first digits of its UUID or SHA-256; ROBOT if it has only one";

namespace {

using Tables = std::vector<v1::CompensationTable>;

constexpr size_t kUuidLength = 36, kDigestLength = 64, kMostNamed = 10;

// What was typed: "ur10", "ur10/5f0c2c", "robots/ur10/compensationTables/5f0c2c...", "5f0c2c".
struct Typed {
  std::string robot;  // robots/{robot}, "" = not said
  std::string id;     // a UUID, or how one or a digest begins; "" = not said
  bool is_robot_or_id = false;
};

Typed ParseTyped(const std::string& typed) {
  const std::vector<std::string> parts = absl::StrSplit(typed, '/');
  if (parts.size() == 1) return {RobotName(typed), typed, true};
  if (parts.size() == 2 && parts[0] == "robots") return {typed, ""};
  if (parts.size() == 2) return {RobotName(parts[0]), parts[1]};
  if (parts.size() == 4) return {absl::StrCat(parts[0], "/", parts[1]), parts[3]};
  return {"", typed};
}

bool IsHex(const std::string& id) {
  return id.find_first_not_of("0123456789abcdef-") == std::string::npos;
}

bool IsPrefix(const std::string& id) {
  return id.size() >= kShortestPrefix && id.size() <= kDigestLength && IsHex(id);
}

absl::StatusOr<v1::CompensationTable> Get(const client::Client& client, const Typed& typed) {
  v1::GetCompensationTableRequest request;
  request.set_name(absl::StrCat(typed.robot, "/compensationTables/", typed.id));
  return client.GetCompensationTable(request);
}

// Those that are deleted, or those that are not.
absl::StatusOr<Tables> List(const client::Client& client, const std::string& robot,
                            const std::string& filter, bool deleted) {
  v1::ListCompensationTablesRequest first;
  first.set_parent(robot);
  first.set_filter(filter);
  first.set_show_deleted(deleted);
  Tables tables;
  TRUEPOSE_RETURN_IF_ERROR(client::ForEachPage(
      first, [&](const auto& request) { return client.ListCompensationTables(request); },
      [&](const v1::ListCompensationTablesResponse& page) {
        for (const v1::CompensationTable& table : page.compensation_tables())
          if (table.has_delete_time() == deleted) tables.push_back(table);
        return absl::OkStatus();
      }));
  return tables;
}

absl::StatusOr<Tables> BeginningSo(const client::Client& client, const std::string& robot,
                                   const std::string& id, bool deleted) {
  Tables found;
  const bool whole = id.size() == kDigestLength;
  for (const std::string& filter : {absl::StrCat("sha256 = \"", id, whole ? "" : "*", "\""),
                                    absl::StrCat("name = \"*/compensationTables/", id, "*\"")}) {
    TRUEPOSE_ASSIGN_OR_RETURN(const Tables tables, List(client, robot, filter, deleted));
    found.insert(found.end(), tables.begin(), tables.end());
  }
  return found;
}

std::string Names(const Tables& tables) {
  std::vector<std::string> names;
  for (const v1::CompensationTable& table : tables) {
    if (names.size() == kMostNamed) break;
    names.push_back(ShortTable(table.name()));
  }
  const size_t more = tables.size() - names.size();
  return absl::StrCat(absl::StrJoin(names, ", "), more > 0 ? absl::StrCat(" and ", more) : "",
                      more > 0 ? " more" : "");
}

absl::Status Refused(absl::StatusCode code, const std::string& typed, const std::string& why,
                     const std::string& expected) {
  FaultList faults;
  faults.Add("TABLE", absl::StrCat(typed, ", ", why), expected);
  return faults.ToStatus(code);
}

absl::Status Refused(absl::StatusCode code, const std::string& typed, const std::string& why,
                     const Tables& tables) {
  return Refused(code, typed, why, tables.empty() ? "a table of `table list`" : Names(tables));
}

absl::Status OnTheOtherSide(const std::string& typed, bool deleted) {
  return Refused(absl::StatusCode::kNotFound, typed,
                 deleted ? "which is not deleted" : "which is deleted",
                 deleted ? "a deleted table" : "a table that is not deleted");
}

absl::StatusOr<v1::CompensationTable> OneOf(Tables tables, const std::string& typed,
                                            const std::string& what) {
  if (tables.size() == 1) return std::move(tables[0]);
  const auto code =
      tables.empty() ? absl::StatusCode::kNotFound : absl::StatusCode::kInvalidArgument;
  return Refused(code, typed,
                 tables.empty()
                     ? absl::StrCat("of which there is no ", what)
                     : absl::StrCat("of which there are ", tables.size(), " ", what, "s"),
                 tables);
}

// By UUID, or as it begins; the tables of the robot are named when there is none.
absl::StatusOr<v1::CompensationTable> FindById(const client::Client& client, const Typed& typed,
                                               const std::string& text, bool deleted) {
  if (typed.id.size() == kUuidLength) return Get(client, typed);
  Tables found;
  if (IsPrefix(typed.id)) {
    TRUEPOSE_ASSIGN_OR_RETURN(found, BeginningSo(client, typed.robot, typed.id, deleted));
  }
  if (!found.empty()) return OneOf(std::move(found), text, "table that begins so");
  if (IsPrefix(typed.id)) {
    TRUEPOSE_ASSIGN_OR_RETURN(found, BeginningSo(client, typed.robot, typed.id, !deleted));
  }
  if (!found.empty()) return OnTheOtherSide(text, deleted);
  TRUEPOSE_ASSIGN_OR_RETURN(const Tables all, List(client, typed.robot, "", deleted));
  return Refused(absl::StatusCode::kNotFound, text, "which is no table's", all);
}

// Why digits are no table's, to somebody who may have meant one on the other side of deletion.
absl::StatusOr<v1::CompensationTable> NoTable(const client::Client& client,
                                              const std::string& typed, bool deleted) {
  if (!IsPrefix(typed)) {
    return FaultStatus("TABLE",
                       absl::StrCat(typed, ", which is no robot and too short for a table"),
                       absl::StrCat("ROBOT/UUID, or ", kShortestPrefix,
                                    " or more first digits of a UUID or SHA-256"));
  }
  TRUEPOSE_ASSIGN_OR_RETURN(const Tables others, BeginningSo(client, "", typed, !deleted));
  if (!others.empty()) return OnTheOtherSide(typed, deleted);
  return Refused(absl::StatusCode::kNotFound, typed, "which is no table's and no robot", Tables());
}

// Somebody who typed digits meant a table, if there is no robot of that name.
absl::StatusOr<v1::CompensationTable> OrByPrefix(const client::Client& client,
                                                 const std::string& typed, bool deleted,
                                                 absl::StatusOr<v1::CompensationTable> of_robot) {
  const bool is_no_robot =
      absl::IsNotFound(of_robot.status()) || absl::IsInvalidArgument(of_robot.status());
  if (!is_no_robot || !IsHex(typed)) return of_robot;
  Tables found;
  if (IsPrefix(typed)) {
    TRUEPOSE_ASSIGN_OR_RETURN(found, BeginningSo(client, "", typed, deleted));
  }
  if (found.empty()) return NoTable(client, typed, deleted);
  return OneOf(std::move(found), typed, "table that begins so");
}

absl::StatusOr<v1::CompensationTable> Active(const client::Client& client,
                                             const std::string& robot) {
  v1::GetActiveCompensationTableRequest request;
  request.set_robot(robot);
  return client.GetActiveCompensationTable(request);
}

absl::StatusOr<v1::CompensationTable> Only(const client::Client& client, const std::string& robot,
                                           const std::string& typed, bool deleted) {
  TRUEPOSE_ASSIGN_OR_RETURN(Tables tables, List(client, robot, "", deleted));
  return OneOf(std::move(tables), typed, deleted ? "deleted table" : "table");
}

}  // namespace

std::string ShortTable(const std::string& name) {
  const std::vector<std::string> parts = absl::StrSplit(name, '/');
  return parts.size() == 4 ? absl::StrCat(parts[1], "/", parts[3]) : name;
}

absl::StatusOr<v1::CompensationTable> FindTable(const client::Client& client,
                                                const std::string& text) {
  const Typed typed = ParseTyped(text);
  if (typed.is_robot_or_id || typed.id.empty())
    return OrByPrefix(client, text, false, Active(client, typed.robot));
  return FindById(client, typed, text, false);
}

absl::StatusOr<v1::CompensationTable> FindTableToChange(const client::Client& client,
                                                        const std::string& text, bool deleted) {
  const Typed typed = ParseTyped(text);
  if (typed.is_robot_or_id || typed.id.empty())
    return OrByPrefix(client, text, deleted, Only(client, typed.robot, text, deleted));
  return FindById(client, typed, text, deleted);
}

}  // namespace truepose::cli
