// truepose: the command line of the calibration service.
#include <langinfo.h>
#include <signal.h>
#include <unistd.h>

#include <clocale>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string_view>

#include "client/cli/truepose.h"

namespace {

// https://no-color.org: any value of NO_COLOR means none.
bool WantsColour() {
  const char* terminal = std::getenv("TERM");
  const bool dumb = terminal == nullptr || std::string_view(terminal) == "dumb";
  return isatty(STDOUT_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr && !dumb;
}

// Asks the locale of the user, then goes back to "C": numbers of ours have a point everywhere.
bool LocaleIsUtf8() {
  std::setlocale(LC_CTYPE, "");
  const bool utf8 = std::string_view(nl_langinfo(CODESET)) == "UTF-8";
  std::setlocale(LC_CTYPE, "C");
  return utf8;
}

}  // namespace

int main(int argc, char** argv) {
  // A reader that goes away (`| head`) is a write error like any other.
  signal(SIGPIPE, SIG_IGN);
  const truepose::cli::Console console{std::cout, std::cerr, isatty(STDERR_FILENO) != 0,
                                       WantsColour(), LocaleIsUtf8()};
  return truepose::cli::RunTruepose({argv + 1, argv + argc}, console);
}
