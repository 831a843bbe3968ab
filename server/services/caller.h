// Who calls.
#pragma once

#include <string>

namespace truepose::services {

struct Caller {
  std::string principal = "local-dev";
  bool is_machine = false;
  bool is_admin = true;
  bool is_local_dev = true;  // a server that is open to everybody (--dev-open)
};

}  // namespace truepose::services
