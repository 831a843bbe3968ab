// A session back as a file.
#include <gmock/gmock.h>

#include "tests/cli/remote_fixture.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

using DownloadCommandTest = RemoteFixture;

// Would catch readings that are lost or rounded: the exported file calibrates to the same report,
// bit for bit.
TEST_F(DownloadCommandTest, AnExportedSessionIsTheImportedOne) {
  AddRobot();
  Import();
  const std::string file = folder_.Path("back.csv");
  EXPECT_THAT(Demand({"session", "export", kUuid, "--output", file}).out, HasSubstr("40 readings"));
  const auto calibrated = [&](const std::string& session) {
    return RunCli({"calibrate", "--local", "--robot", robot_, "--session", session, "--json"}).out;
  };
  EXPECT_EQ(calibrated(file), calibrated(session_));
  const Ran unknown = Remote({"session", "export", kOtherUuid, "--output", file});
  EXPECT_EQ(unknown.code, 6);
  EXPECT_THAT(unknown.err, HasSubstr("truepose session list"));
}

}  // namespace
}  // namespace truepose::cli
