#include "server/auth/bootstrap.h"

#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::auth {
namespace {

using testing::HasCode;
using testing::IsOk;

class BootstrapTest : public ::testing::Test {
 protected:
  std::string Content() const {
    std::string line;
    std::ifstream file(path_);
    std::getline(file, line);
    return line;
  }
  // Uses `secret`, counting in uses_ how often that granted anything.
  absl::Status Use(Bootstrap& bootstrap, const std::string& secret,
                   const absl::Status& granted = absl::OkStatus()) {
    return bootstrap.Use(secret, [&] {
      ++uses_;
      return granted;
    });
  }

  testing::TempDir folder_;
  const std::string path_ = folder_.File("t.db.bootstrap");
  int uses_ = 0;
};

// Would catch a secret that others on the machine can read, or that goes into a file that somebody
// laid there for it.
TEST_F(BootstrapTest, TheFileIsNewAndOursAlone) {
  std::ofstream(folder_.File("elsewhere")) << "x";
  std::filesystem::create_symlink(folder_.File("elsewhere"), path_);
  const auto bootstrap = Bootstrap::Begin(path_, true);
  ASSERT_THAT(bootstrap, IsOk());
  struct stat status {};
  ASSERT_EQ(lstat(path_.c_str(), &status), 0);
  EXPECT_TRUE(S_ISREG(status.st_mode));
  EXPECT_EQ(status.st_mode & 0777, 0600u);
  EXPECT_EQ(std::filesystem::file_size(folder_.File("elsewhere")), 1u);
  EXPECT_EQ((*bootstrap)->waiting_file(), path_);
}

// Would catch a secret that makes two admins, or a file that stays behind.
TEST_F(BootstrapTest, ItServesOnce) {
  const auto bootstrap = Bootstrap::Begin(path_, true);
  ASSERT_THAT(bootstrap, IsOk());
  const std::string secret = Content();
  EXPECT_THAT(Use(**bootstrap, secret + "\n"), IsOk()) << "as `cat` gives it";
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_EQ((*bootstrap)->waiting_file(), "");
  EXPECT_THAT(Use(**bootstrap, secret), HasCode(absl::StatusCode::kFailedPrecondition));
  EXPECT_EQ(uses_, 1);
}

// Would catch a guess that gets in, and a wrong one that uses the secret up.
TEST_F(BootstrapTest, AnotherSecretIsRefused) {
  const auto bootstrap = Bootstrap::Begin(path_, true);
  ASSERT_THAT(bootstrap, IsOk());
  for (const char* wrong : {"", "truepose-", "x"})
    EXPECT_THAT(Use(**bootstrap, wrong), HasCode(absl::StatusCode::kPermissionDenied));
  EXPECT_EQ(uses_, 0);
  EXPECT_THAT(Use(**bootstrap, Content()), IsOk());
}

// Would catch a disk that was full for a moment and costs the first admin.
TEST_F(BootstrapTest, AGrantThatFailedMayBeTriedAgain) {
  const auto bootstrap = Bootstrap::Begin(path_, true);
  ASSERT_THAT(bootstrap, IsOk());
  EXPECT_THAT(Use(**bootstrap, Content(), absl::ResourceExhaustedError("disk full")),
              HasCode(absl::StatusCode::kResourceExhausted));
  EXPECT_TRUE(std::filesystem::exists(path_));
  EXPECT_THAT(Use(**bootstrap, Content()), IsOk());
}

// Would catch an old secret that still serves after another start, or stays where it is of no use.
TEST_F(BootstrapTest, AnEarlierSecretIsGoneWithTheNextStart) {
  std::string old;
  {
    const auto first = Bootstrap::Begin(path_, true);
    ASSERT_THAT(first, IsOk());
    old = Content();
  }
  EXPECT_FALSE(std::filesystem::exists(path_)) << "of a server that stopped";
  std::ofstream(path_) << old << "\n";  // of a server that was killed
  const auto next = Bootstrap::Begin(path_, true);
  ASSERT_THAT(next, IsOk());
  EXPECT_NE(Content(), old);
  EXPECT_THAT(Use(**next, old), HasCode(absl::StatusCode::kPermissionDenied));
  const auto unwanted = Bootstrap::Begin(path_, false);
  ASSERT_THAT(unwanted, IsOk());
  EXPECT_FALSE(std::filesystem::exists(path_));
  EXPECT_THAT(Use(**unwanted, ""), HasCode(absl::StatusCode::kFailedPrecondition));
}

TEST_F(BootstrapTest, AFolderThatIsNotThereIsAFault) {
  EXPECT_THAT(Bootstrap::Begin(folder_.File("none/t.bootstrap"), true),
              HasCode(absl::StatusCode::kFailedPrecondition));
}

}  // namespace
}  // namespace truepose::auth
