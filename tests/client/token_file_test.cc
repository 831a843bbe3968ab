#include "client/token_file.h"

#include <stdlib.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "client/client.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace truepose::client {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr char kSecret[] = "truepose-0123456789abcdef";

class TokenFileTest : public ::testing::Test {
 protected:
  TokenFileTest() {
    std::string name = (std::filesystem::temp_directory_path() / "tp.XXXXXX").string();
    folder_ = mkdtemp(name.data());
    setenv("HOME", folder_.c_str(), 1);
    unsetenv(kTokenVariable);
  }
  ~TokenFileTest() override {
    std::filesystem::remove_all(folder_);
    unsetenv(kTokenVariable);
  }

  std::string Write(const std::string& name, const std::string& text, mode_t mode = 0600) const {
    const std::filesystem::path path = folder_ / name;
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path) << text;
    chmod(path.c_str(), mode);
    return path.string();
  }

  std::filesystem::path folder_;
};

// Would catch a token that others on the machine can read, used without a word.
TEST_F(TokenFileTest, AFileThatOthersMayReadIsRefused) {
  for (const mode_t mode : {0640, 0604, 0660, 0620}) {
    const auto token = ReadTokenFile(Write("t", kSecret, mode));
    EXPECT_TRUE(absl::IsInvalidArgument(token.status())) << std::oct << mode;
    EXPECT_THAT(std::string(token.status().message()), HasSubstr("chmod 600"));
  }
  EXPECT_EQ(*ReadTokenFile(Write("t", kSecret, 0600)), kSecret);
  EXPECT_EQ(*ReadTokenFile(Write("t", kSecret, 0400)), kSecret);
}

// Would catch a file of something else that is sent to the server, ends the process within gRPC, or
// is shown in a message.
TEST_F(TokenFileTest, OnlyOneLineOfASecretIsTaken) {
  EXPECT_EQ(*ReadTokenFile(Write("t", absl::StrCat(kSecret, "\n"))), kSecret);
  EXPECT_EQ(*ReadTokenFile(Write("t", absl::StrCat(kSecret, "\r\n"))), kSecret);
  for (const std::string& text : {std::string(), std::string("\n"), std::string("two words"),
                                  absl::StrCat(kSecret, "\n", kSecret), std::string(513, 'x'),
                                  std::string("k\xC3\xA4se"), std::string("a\0b", 3)}) {
    const auto token = ReadTokenFile(Write("t", text));
    EXPECT_TRUE(absl::IsInvalidArgument(token.status())) << text.size();
    EXPECT_THAT(std::string(token.status().message()), Not(HasSubstr(kSecret)));
  }
  EXPECT_TRUE(absl::IsInvalidArgument(ReadTokenFile(folder_).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(ReadTokenFile((folder_ / "none").string()).status()));
}

// Would catch another order than the one that is promised.
TEST_F(TokenFileTest, TheFirstThatIsGivenCounts) {
  EXPECT_EQ(*FindToken(""), "");
  Write(kTokenFile, "at-home");
  EXPECT_EQ(*FindToken(""), "at-home");
  setenv(kTokenVariable, "by-variable", 1);
  EXPECT_EQ(*FindToken(""), "by-variable");
  EXPECT_EQ(*FindToken(Write("t", "named")), "named");
  setenv(kTokenVariable, "", 1);
  EXPECT_EQ(*FindToken(""), "at-home");
}

// Would catch a faulty place that is passed over, so that another identity than the meant one
// calls.
TEST_F(TokenFileTest, AFaultyPlaceIsNotPassedOver) {
  Write(kTokenFile, "at-home", 0644);
  EXPECT_TRUE(absl::IsInvalidArgument(FindToken("").status()));
  setenv(kTokenVariable, "two words", 1);
  const auto token = FindToken("");
  EXPECT_TRUE(absl::IsInvalidArgument(token.status()));
  EXPECT_THAT(std::string(token.status().message()), Not(HasSubstr("two words")));
}

TEST_F(TokenFileTest, AClientWithAnUnsendableTokenIsNotMade) {
  const auto client = Client::Connect("127.0.0.1:1", {.token = "line\nbreak"});
  EXPECT_TRUE(absl::IsInvalidArgument(client.status()));
}

}  // namespace
}  // namespace truepose::client
