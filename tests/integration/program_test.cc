// trueposed as a process: its options, exit codes, messages and signals (docs/operations.md).
#include <signal.h>

#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "client/client.h"
#include "gmock/gmock.h"
#include "server/exit_codes.h"
#include "server/store/migrations.h"
#include "server/store/sql/sqlite.h"
#include "tests/integration/server_process.h"
#include "tests/server/testing/examples.h"
#include "tests/server/testing/expect_status.h"

namespace truepose {
namespace {

using server::ExitCode;
using ::testing::HasSubstr;
using testing::IsOk;
using testing::ServerProcess;
using testing::TempDir;

class ProgramTest : public ::testing::Test {
 protected:
  std::string Database() const { return folder_.File("t.db"); }
  // The folder of a second process, which has a socket of its own.
  TempDir folder_, second_;
};

// Would catch a stop that hangs, is called a failure, or leaves files that say the server still
// runs.
TEST_F(ProgramTest, SignalsStopItInOrder) {
  for (const int number : {SIGTERM, SIGINT}) {
    ServerProcess process(folder_, {"--database", Database()});
    ASSERT_TRUE(process.WaitUntilReady()) << process.Output();
    ASSERT_THAT(
        client::Client::Connect(process.address())->CreateRobot(testing::RobotRequest("ur10")),
        IsOk());
    process.Signal(number);
    EXPECT_EQ(process.Wait(), server::kExitOk);
    EXPECT_THAT(process.Output(), HasSubstr("stopped"));
    EXPECT_FALSE(std::filesystem::exists(folder_.File("ready")));
    EXPECT_FALSE(std::filesystem::exists(folder_.File("s.sock")));
  }
}

// Would catch a ready file that is there before the server, or with another address than its own.
TEST_F(ProgramTest, TheReadyFileHasTheAddressThatWasTaken) {
  ServerProcess process(folder_, {"--database", Database(), "--listen", "127.0.0.1:0"});
  ASSERT_TRUE(process.WaitUntilReady()) << process.Output();
  std::string address;
  std::ifstream(folder_.File("ready")) >> address;
  ASSERT_NE(address, "127.0.0.1:0");
  EXPECT_THAT(client::Client::Connect(address)->ListRobots({}), IsOk());
}

// Would catch a script that goes to the address of a server that was killed.
TEST_F(ProgramTest, AReadyFileThatWasLeftBehindIsRemoved) {
  const std::string left = folder_.File("left");
  std::ofstream(left) << "127.0.0.1:1\n";
  ServerProcess process(folder_, {"--database", folder_.File("none/t.db"), "--ready-file", left});
  EXPECT_EQ(process.Wait(), server::kExitDatabase);
  EXPECT_FALSE(std::filesystem::exists(left));
}

// Everything below a folder as one text.
std::string AllBytes(const std::filesystem::path& folder) {
  std::string all;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path(), std::ios::binary);
    all.append(std::istreambuf_iterator<char>(file), {});
  }
  return all;
}

// Would catch a secret in the log or in any file of the database, a bootstrap file that others can
// read, and a server that says nothing of how its first admin comes.
TEST_F(ProgramTest, SecretsAreToldOnceAndKeptNowhere) {
  ServerProcess process(folder_, {"--database", Database(), "--log-level", "debug"},
                        ServerProcess::Access::kTokens);
  ASSERT_TRUE(process.WaitUntilReady()) << process.Output();
  const std::string file = Database() + ".bootstrap";
  EXPECT_THAT(process.Output(), HasSubstr("truepose admin bootstrap " + file));
  v1::BootstrapRequest request;
  std::ifstream(file) >> *request.mutable_secret();
  request.set_principal("anna");
  const auto made = client::Client::Connect(process.address())->Bootstrap(request);
  ASSERT_THAT(made, IsOk());
  const auto client = client::Client::Connect(process.address(), {.token = made->secret()});
  EXPECT_THAT(client->ListRobots({}), IsOk());
  EXPECT_THAT(
      client::Client::Connect(process.address(), {.token = made->secret() + "x"})->ListRobots({}),
      testing::HasCode(absl::StatusCode::kUnauthenticated));
  process.Signal(SIGTERM);
  EXPECT_EQ(process.Wait(), server::kExitOk);
  const std::string all = AllBytes(folder_.path());  // the log among it
  EXPECT_THAT(all, HasSubstr("anna"));
  EXPECT_EQ(all.find(made->secret()), std::string::npos);
  EXPECT_EQ(all.find(request.secret()), std::string::npos);
}

// Would catch a server that is open to everybody and doesn't say so.
TEST_F(ProgramTest, OpenToEverybodyItSaysSo) {
  ServerProcess process(folder_, {"--database", Database(), "--time-zone", "Asia/Tokyo"});
  ASSERT_TRUE(process.WaitUntilReady()) << process.Output();
  EXPECT_THAT(process.Output(), HasSubstr("--dev-open"));
  const auto status = client::Client::Connect(process.address())->GetServerStatus({});
  ASSERT_THAT(status, IsOk());
  EXPECT_TRUE(status->dev_open());
  EXPECT_EQ(status->principal(), "local-dev");
  EXPECT_EQ(status->time_zone(), "Asia/Tokyo");
  EXPECT_GT(status->database_bytes(), 0);
}

TEST_F(ProgramTest, HelpAndVersionAreNoFailure) {
  ServerProcess help(folder_, {"--help"});
  EXPECT_EQ(help.Wait(), server::kExitOk);
  EXPECT_THAT(help.Output(), ::testing::AllOf(HasSubstr("--database"), HasSubstr("Exit codes")));
  ServerProcess version(folder_, {"--version"});
  EXPECT_EQ(version.Wait(), server::kExitOk);
}

// Would catch a mistyped option that is taken for a default.
TEST_F(ProgramTest, UsageIsExitCode2) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--databse", "t.db"},        {"--workers", "many"},           {"--workers", "0"},
      {"--listen", "0.0.0.0:7878"}, {"--time-zone", "Nowhere/Land"}, {"--log-level", "loud"}};
  for (const auto& arguments : wrong) {
    ServerProcess process(folder_, arguments);
    EXPECT_EQ(process.Wait(), server::kExitUsage) << arguments[0] << " " << arguments[1];
    EXPECT_NE(process.Output(), "");
  }
}

// Would catch a message without what was found and expected, and a database made for nothing.
TEST_F(ProgramTest, AnAddressInUseIsExitCode4) {
  ServerProcess first(folder_, {"--database", Database()});
  ASSERT_TRUE(first.WaitUntilReady()) << first.Output();
  ServerProcess second(second_, {"--database", second_.File("s.db"), "--listen", first.address()});
  EXPECT_EQ(second.Wait(), server::kExitUnavailable);
  EXPECT_THAT(second.Output(), HasSubstr("in use by another process, expected"));
  EXPECT_FALSE(std::filesystem::exists(second_.File("s.db")));
  EXPECT_THAT(client::Client::Connect(first.address())->ListRobots({}), IsOk())
      << "the first lost its socket";
}

// Would catch two servers on one database, which would run each job twice.
TEST_F(ProgramTest, ASecondServerOnOneDatabaseIsExitCode5) {
  ServerProcess first(folder_, {"--database", Database()});
  ASSERT_TRUE(first.WaitUntilReady()) << first.Output();
  ServerProcess second(second_, {"--database", Database()});
  EXPECT_EQ(second.Wait(), server::kExitDatabase);
  EXPECT_THAT(second.Output(), ::testing::AllOf(HasSubstr(Database()), HasSubstr("expected")));
}

// Would catch a file of measurements that is overwritten by a mistyped path.
TEST_F(ProgramTest, AFileThatIsNoDatabaseIsExitCode5AndStays) {
  const std::string text(5000, 'x');
  std::ofstream(Database()) << text;
  ServerProcess process(folder_, {"--database", Database()});
  EXPECT_EQ(process.Wait(), server::kExitDatabase);
  EXPECT_THAT(process.Output(), ::testing::AllOf(HasSubstr(Database()), HasSubstr("expected")));
  EXPECT_EQ(std::filesystem::file_size(Database()), text.size());
}

// Brings a database to a form that only a later program knows.
void MakeNewer(const std::string& path) {
  const auto connection = store::sql::OpenSqlite(path, store::sql::Access::kWrite);
  ASSERT_THAT(connection, IsOk());
  const auto known = store::EmbeddedMigrations();
  const int next = static_cast<int>(known.size()) + 1;
  const std::string text =
      absl::StrCat("-- min_compatible: ", next, "\nCREATE TABLE later (id INTEGER) STRICT;\n");
  std::vector<store::Migration> newer(known.begin(), known.end());
  newer.push_back({next, "later", text});
  ASSERT_THAT(store::Migrate(**connection, newer, store::RealClock(), path), IsOk());
}

// Would catch an old program that writes into a form it does not understand, after an upgrade was
// taken back.
TEST_F(ProgramTest, ADatabaseOfANewerVersionIsExitCode5) {
  ASSERT_NO_FATAL_FAILURE(MakeNewer(Database()));
  ServerProcess process(folder_, {"--database", Database()});
  EXPECT_EQ(process.Wait(), server::kExitDatabase);
  EXPECT_THAT(process.Output(),
              ::testing::AllOf(HasSubstr(Database()), HasSubstr("newer"), HasSubstr("expected")));
  EXPECT_FALSE(std::filesystem::exists(folder_.File("s.sock")));
}

TEST_F(ProgramTest, AFolderThatIsNotThereIsExitCode5) {
  ServerProcess process(folder_, {"--database", folder_.File("none/t.db")});
  EXPECT_EQ(process.Wait(), server::kExitDatabase);
  EXPECT_THAT(process.Output(), HasSubstr("none"));
}

}  // namespace
}  // namespace truepose
