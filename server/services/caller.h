// Who calls.
#pragma once

#include <string>

namespace truepose::services {

struct Caller {
  std::string principal = "local-dev";
  bool is_machine = false;
  bool is_admin = true;
};

}  // namespace truepose::services
