#include "client/agent/released/released_entry.h"

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"
#include "core/base/status_macros.h"
#include "nlohmann/json.hpp"

namespace truepose::agent {
namespace {

using Json = nlohmann::ordered_json;

Json EntryJson(const ReleasedEntry& entry) {
  return {{"table", entry.table},
          {"sha256", entry.sha256},
          {"calibration", entry.calibration},
          {"calibration_digest", entry.calibration_digest},
          {"nominal_digest", entry.nominal_digest},
          {"serial", entry.serial},
          {"activated", TimeText(entry.activated_us)},
          {"activated_us", entry.activated_us},
          {"revision", entry.revision}};
}

ReleasedEntry EntryOf(const Json& json) {
  ReleasedEntry entry;
  entry.table = json.at("table");
  entry.sha256 = json.at("sha256");
  entry.calibration = json.at("calibration");
  entry.calibration_digest = json.at("calibration_digest");
  entry.nominal_digest = json.at("nominal_digest");
  entry.serial = json.at("serial");
  entry.activated_us = json.at("activated_us");
  entry.revision = json.at("revision");
  return entry;
}

absl::StatusOr<std::vector<ReleasedEntry>> SetsOf(const Json& json, const std::string& robot) {
  const std::string found = json.at("robot");
  if (found != robot)
    return absl::FailedPreconditionError(absl::StrCat("is of ", found, ", expected ", robot));
  std::vector<ReleasedEntry> entries;
  for (const Json& set : json.at("sets")) {
    entries.push_back(EntryOf(set));
    if (!IsDigest(entries.back().sha256))
      return absl::InvalidArgumentError(absl::StrCat("sha256: found '", entries.back().sha256,
                                                     "', expected 64 digits of lower-case hex"));
  }
  return entries;
}

}  // namespace

bool IsDigest(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool IsOlder(const ReleasedEntry& offered, const ReleasedEntry& running) {
  return offered.calibration != running.calibration &&
         offered.activated_us < running.activated_us && offered.revision <= running.revision;
}

std::string ToJson(const std::string& robot, const std::vector<ReleasedEntry>& sets) {
  Json list = Json::array();
  for (const ReleasedEntry& entry : sets) list.push_back(EntryJson(entry));
  const Json json = {{"robot", robot}, {"sets", list}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

absl::StatusOr<std::vector<ReleasedEntry>> EntriesFromJson(const std::string& text,
                                                           const std::string& robot) {
  try {
    return SetsOf(Json::parse(text), robot);
  } catch (const Json::exception& e) {
    return absl::InvalidArgumentError(e.what());
  }
}

std::string ShortName(const std::string& name) {
  const size_t begin = name.find('/', name.find('/') + 1);
  return begin == std::string::npos ? name : name.substr(begin + 1);
}

std::string TimeText(int64_t time_us) {
  return absl::FormatTime("%Y-%m-%dT%H:%M:%SZ", absl::FromUnixMicros(time_us), absl::UTCTimeZone());
}

}  // namespace truepose::agent
