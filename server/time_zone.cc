#include "server/time_zone.h"

#include <cstdlib>
#include <filesystem>

#include "absl/time/time.h"

namespace truepose::server {
namespace {

constexpr char kFolder[] = "zoneinfo/";

// What stands behind the folder of zones in a path, such as Europe/Berlin; "" when that is none.
std::string NameIn(const std::string& path) {
  const size_t folder = path.rfind(kFolder);
  if (folder == std::string::npos) return "";
  return path.substr(folder + sizeof(kFolder) - 1);
}

bool IsZone(const std::string& name) {
  absl::TimeZone zone;
  return !name.empty() && name.front() != '/' && absl::LoadTimeZone(name, &zone);
}

}  // namespace

std::string SystemTimeZone() {
  const char* variable = std::getenv("TZ");
  std::string name = variable == nullptr ? "" : variable;
  if (name.starts_with(':')) name.erase(0, 1);
  if (IsZone(name)) return name;
  std::error_code error;
  name = NameIn(std::filesystem::read_symlink("/etc/localtime", error).string());
  return IsZone(name) ? name : "UTC";
}

}  // namespace truepose::server
