// The whole program as a function, so that tests call it as the shell does.
#pragma once

#include <string>
#include <vector>

#include "client/cli/console.h"

namespace truepose::cli {

// @param arguments without the program's name.
// @returns the exit code (client/exit_codes.h). Never throws.
int RunTruepose(const std::vector<std::string>& arguments, const Console& console);

}  // namespace truepose::cli
