// One process a database.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "server/store/store.h"
#include "tests/store/testing/samples.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::store {
namespace {

using ::testing::HasSubstr;

// A process that opens `path`, says so through a pipe, and waits to be killed.
class Holder {
 public:
  explicit Holder(const std::string& path) {
    EXPECT_EQ(pipe(pipe_), 0);
    child_ = fork();
    if (child_ == 0) Hold(path);
    char said = 0;
    EXPECT_EQ(read(pipe_[0], &said, 1), 1);
    EXPECT_EQ(said, '1');
  }
  ~Holder() {
    kill(child_, SIGKILL);
    waitpid(child_, nullptr, 0);
    close(pipe_[0]);
    close(pipe_[1]);
  }
  pid_t child() const { return child_; }

 private:
  [[noreturn]] void Hold(const std::string& path) {
    const auto store = Store::Open({.path = path});
    const char say = store.ok() ? '1' : '0';
    if (write(pipe_[1], &say, 1) != 1) _exit(1);
    for (;;) pause();
  }

  int pipe_[2];
  pid_t child_;
};

// Catches two servers on one database, and a message that doesn't help to find the other one.
TEST(Lock, ASecondProcessIsToldWhoHoldsTheDatabase) {
  TemporaryFolder folder;
  const std::string path = folder.Path("a.db");
  const Holder holder(path);
  const absl::Status status = Store::Open({.path = path}).status();
  EXPECT_EQ(status.code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_THAT(std::string(status.message()),
              HasSubstr("process " + std::to_string(holder.child()) + ","));
  EXPECT_EQ(FaultFields(status), std::vector<std::string>{path});
  EXPECT_EQ(ReadFile(path + ".lock"), std::to_string(holder.child()) + "\n");
}

// Catches a lock that outlives its process: the file stays after kill -9, the lock must not.
TEST(Lock, AKilledProcessHoldsNothing) {
  TemporaryFolder folder;
  const std::string path = folder.Path("a.db");
  { const Holder holder(path); }
  EXPECT_EQ(folder.Files().count("a.db.lock"), 1u);
  EXPECT_TRUE(Store::Open({.path = path}).ok());
  EXPECT_EQ(folder.Files().count("a.db.lock"), 0u);
}

// Catches a second name of the same file that meets another lock.
TEST(Lock, EveryNameOfTheFileMeetsTheSameLock) {
  TemporaryFolder folder;
  const auto store = Store::Open({.path = folder.Path("a.db")});
  ASSERT_TRUE(store.ok()) << store.status();
  std::filesystem::create_symlink(folder.Path("a.db"), folder.Path("link.db"));
  EXPECT_EQ(Store::Open({.path = folder.Path("link.db")}).status().code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(Store::Open({.path = folder.Path("./a.db")}).status().code(),
            absl::StatusCode::kFailedPrecondition);
}

}  // namespace
}  // namespace truepose::store
