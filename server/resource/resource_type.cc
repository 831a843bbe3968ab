#include "server/resource/resource_type.h"

#include <algorithm>
#include <array>

namespace truepose::resource {

bool IsStandardField(const std::string& field) {
  static constexpr std::array<const char*, 8> kFields = {
      "name", "uid", "create_time", "update_time", "delete_time", "revision", "etag", "version"};
  return std::find(kFields.begin(), kFields.end(), field) != kFields.end();
}

}  // namespace truepose::resource
