// Tokens and the server's status on the command line, against a server in this process that asks
// for tokens.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <memory>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "server/calibration_runner.h"
#include "server/server.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class TokenTest : public ::testing::Test {
 protected:
  void SetUp() override {
    // No token of who runs the tests.
    setenv("HOME", folder_.Path("home").c_str(), 1);
    unsetenv("TRUEPOSE_TOKEN");
    Start(false);
  }
  void TearDown() override { unsetenv("TRUEPOSE_TOKEN"); }

  void Start(bool dev_open) {
    server_.reset();
    server::ServerOptions options;
    options.listen = absl::StrCat("unix:", folder_.Path("socket"));
    options.database = folder_.Path("t.db");
    options.time_zone = "Asia/Tokyo";
    options.dev_open = dev_open;
    auto started = server::Server::Start(options, server::CalibrationRunner());
    ASSERT_TRUE(started.ok()) << started.status();
    server_ = *std::move(started);
  }

  Ran Remote(std::vector<std::string> line, const std::string& token_file = "") const {
    line.insert(line.end(), {"--server", server_->address()});
    if (!token_file.empty()) line.insert(line.end(), {"--token-file", token_file});
    return RunCli(line);
  }
  // Makes `admin`, whose token is in the file that it returns.
  std::string Bootstrap() const {
    const Ran ran = Remote({"admin", "bootstrap", server_->bootstrap_file(), "--principal", "admin",
                            "--output", admin_});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return admin_;
  }
  std::string SecretIn(const std::string& path) const {
    return std::string(absl::StripAsciiWhitespace(TextOf(path)));
  }

  const TempFolder folder_;
  const std::string admin_ = folder_.Path("admin.token");
  std::unique_ptr<server::Server> server_;
};

// Would catch a secret that is printed although it went into a file, or a file that others can
// read.
TEST_F(TokenTest, TheFirstAdminComesByTheFileBesideTheDatabase) {
  const Ran ran = Remote({"admin", "bootstrap", server_->bootstrap_file(), "--principal", "admin",
                          "--output", admin_});
  ASSERT_EQ(ran.code, 0) << ran.err;
  struct stat status {};
  ASSERT_EQ(stat(admin_.c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  EXPECT_THAT(ran.out, AllOf(HasSubstr("admin, an admin"), Not(HasSubstr(SecretIn(admin_)))));
  EXPECT_EQ(Remote({"token", "list"}, admin_).code, 0);
  EXPECT_EQ(server_->bootstrap_file(), "");
}

// Would catch a refusal that does not say what to do, or a code that scripts can't tell from a
// fault of the input.
TEST_F(TokenTest, WithoutATokenItSaysWhereOneIsLookedFor) {
  const Ran ran = Remote({"robot", "list"});
  EXPECT_EQ(ran.code, 7);
  EXPECT_EQ(ran.out, "");
  EXPECT_THAT(ran.err, AllOf(HasSubstr("found no token"), HasSubstr("truepose token create"),
                             HasSubstr("--token-file"), HasSubstr("TRUEPOSE_TOKEN")));
  EXPECT_EQ(Remote({"status"}).code, 7);
}

// Would catch a command that knows one of the ways only.
TEST_F(TokenTest, ATokenIsTakenFromFileVariableAndHome) {
  const std::string secret = SecretIn(Bootstrap());
  EXPECT_EQ(Remote({"robot", "list"}, admin_).code, 0);
  setenv("TRUEPOSE_TOKEN", secret.c_str(), 1);
  EXPECT_EQ(Remote({"robot", "list"}).code, 0);
  unsetenv("TRUEPOSE_TOKEN");
  std::filesystem::create_directories(folder_.Path("home/.config/truepose"));
  const std::string at_home = folder_.Write("home/.config/truepose/token", secret + "\n");
  chmod(at_home.c_str(), 0644);
  const Ran open = Remote({"robot", "list"});
  EXPECT_EQ(open.code, 3);
  EXPECT_THAT(open.err, AllOf(HasSubstr("chmod 600"), Not(HasSubstr(secret))));
  chmod(at_home.c_str(), 0600);
  EXPECT_EQ(Remote({"robot", "list"}).code, 0);
}

// Would catch a token that can't be used, listed or ended from the command line, and a secret that
// comes back.
TEST_F(TokenTest, CreateListRevoke) {
  Bootstrap();
  const std::string cell = folder_.Path("cell.token");
  ASSERT_EQ(Remote({"token", "create", "--principal", "cell-7", "--kind", "machine", "--expires",
                    "90d", "--output", cell},
                   admin_)
                .code,
            0);
  EXPECT_THAT(Remote({"status"}, cell).out, HasSubstr("cell-7, a machine"));
  const Ran denied = Remote({"token", "list"}, cell);
  EXPECT_EQ(denied.code, 7);
  EXPECT_THAT(denied.err, HasSubstr("an admin's token"));
  const Ran list = Remote({"token", "list"}, admin_);
  EXPECT_THAT(list.out, AllOf(HasSubstr("cell-7"), HasSubstr("until "), HasSubstr("person, admin"),
                              Not(HasSubstr(SecretIn(cell)))));
  const Ran json = Remote({"token", "list", "--json"}, admin_);
  const std::string name = At(OneObject(json.out), "tokens.0.name");
  const Ran revoked = Remote({"token", "revoke", name}, admin_);
  EXPECT_EQ(revoked.code, 0) << revoked.err;
  EXPECT_THAT(revoked.out, HasSubstr("revoked"));
  const Ran after = Remote({"status"}, cell);
  EXPECT_EQ(after.code, 7);
  EXPECT_THAT(after.err, AllOf(HasSubstr("was revoked at"), Not(HasSubstr(SecretIn(cell)))));
}

// Would catch an order to make a token whose secret then has no place to go.
TEST_F(TokenTest, AFileThatIsThereIsNeitherLostNorWorthAToken) {
  Bootstrap();
  const std::string before = TextOf(admin_);
  const Ran ran = Remote({"token", "create", "--principal", "ben", "--output", admin_}, admin_);
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("--output"));
  EXPECT_EQ(TextOf(admin_), before);
  EXPECT_EQ(At(OneObject(Remote({"token", "list", "--json"}, admin_).out), "tokens"), "[1]");
  const std::string left = folder_.Path("left");
  EXPECT_EQ(Remote({"token", "create", "--principal", "BEN", "--output", left}, admin_).code, 3);
  EXPECT_FALSE(std::filesystem::exists(left)) << "an empty file of no token";
}

// Would catch faults in the words of the API instead of those of the options.
TEST_F(TokenTest, FaultsNameTheOptions) {
  Bootstrap();
  const Ran name = Remote({"token", "create", "--principal", "Ben B."}, admin_);
  EXPECT_EQ(name.code, 3);
  EXPECT_THAT(name.err, HasSubstr("--principal: found 'Ben B.'"));
  const Ran kind = Remote({"token", "create", "--principal", "ben", "--kind", "robot"}, admin_);
  EXPECT_EQ(kind.code, 3);
  EXPECT_THAT(kind.err, HasSubstr("--kind"));
  for (const char* when : {"0d", "soon", "2027-13-01", "99999999d"}) {
    const Ran expires =
        Remote({"token", "create", "--principal", "ben", "--expires", when}, admin_);
    EXPECT_EQ(expires.code, 3) << when;
    EXPECT_THAT(expires.err, HasSubstr("--expires")) << when;
  }
  EXPECT_EQ(
      Remote({"token", "create", "--principal", "ben", "--expires", "2001-01-01"}, admin_).code, 3)
      << "passed long ago";
  const Ran wrong =
      Remote({"admin", "bootstrap", folder_.Write("x", "guess\n"), "--principal", "b"});
  EXPECT_EQ(wrong.code, 1) << "this server has an admin: " << wrong.err;
}

// Would catch a server that is open to everybody and looks like one that is not.
TEST_F(TokenTest, TheStatusSaysThatAServerIsOpenToEverybody) {
  const Ran closed = Remote({"status"}, Bootstrap());
  EXPECT_THAT(closed.out, AllOf(HasSubstr("admin, a person"), HasSubstr("Asia/Tokyo"),
                                HasSubstr("0 robots"), Not(HasSubstr("--dev-open"))));
  Start(true);
  const Ran open = Remote({"status"});
  ASSERT_EQ(open.code, 0) << open.err;
  EXPECT_THAT(open.out,
              AllOf(HasSubstr("Open to everybody (--dev-open)"), HasSubstr("local-dev, a person")));
  EXPECT_EQ(At(OneObject(Remote({"status", "--json"}).out), "dev_open"), "true");
  const Ran create = Remote({"token", "create", "--principal", "eve", "--admin"});
  EXPECT_EQ(create.code, 1);
  EXPECT_THAT(create.err, HasSubstr("--dev-open"));
}

}  // namespace
}  // namespace truepose::cli
