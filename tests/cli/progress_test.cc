#include "client/cli/progress.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace truepose::cli {
namespace {

// Would catch control characters in a log file.
TEST(ProgressBar, IsSilentWithoutATerminal) {
  std::ostringstream out, err;
  const Console console{out, err};
  {
    ProgressBar bar(console, "import");
    bar.Show(0.5, "half");
  }
  EXPECT_EQ(out.str() + err.str(), "");
}

// Would catch a bar that stays in front of the next line or repeats itself.
TEST(ProgressBar, DrawsChangesAndClearsItself) {
  std::ostringstream out, err;
  const Console console{out, err, /*err_is_terminal=*/true};
  {
    ProgressBar bar(console, "import");
    bar.Show(0.5, "half");
    bar.Show(0.5, "half");
  }
  EXPECT_EQ(err.str(), "\r\x1b[Kimport ###############...............  50 %  half\r\x1b[K");
  EXPECT_EQ(out.str(), "");
}

// Would catch a crash on figures that a server should not send but might.
TEST(ProgressBar, LimitsItsFraction) {
  std::ostringstream out, err;
  const Console console{out, err, /*err_is_terminal=*/true};
  ProgressBar bar(console, "x");
  for (const double fraction : {-1.0, 7.0, std::nan("")}) bar.Show(fraction, "");
  EXPECT_NE(err.str().find("  0 %"), std::string::npos);
  EXPECT_NE(err.str().find("100 %"), std::string::npos);
}

}  // namespace
}  // namespace truepose::cli
