// Who calls.
#pragma once

#include <string>

namespace truepose::auth {

inline constexpr char kLocalDev[] = "local-dev";

// As it is made: whoever calls a server that is open to everybody (--dev-open).
struct Caller {
  std::string principal = kLocalDev;
  bool is_machine = false;
  bool is_admin = true;
  bool is_local_dev = true;
  std::string token = {};  // name of the token that was shown; "" = none was asked for
};

}  // namespace truepose::auth
