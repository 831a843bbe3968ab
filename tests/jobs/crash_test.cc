// A server is ended at each statement of a job's life, and started again. No job whose creation was
// acknowledged is lost, and none has two results. This proves the death of a process only, as kill
// -9 would: what the system had taken is still written, as after a power loss it would not be.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <memory>
#include <string>

#include "server/jobs/engine.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "tests/jobs/engine_testing.h"
#include "tests/store/testing/faulty_connection.h"
#include "tests/store/testing/samples.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::jobs {
namespace {

constexpr int kCrashed = 99;
const std::string kName = store::JobName(store::Uuid(1));

absl::StatusOr<v1::Calibration> RunQuickly(const v1::CalibrationInput&, const RunnerHooks&) {
  return store::SampleCalibration();
}

[[noreturn]] absl::StatusOr<v1::Calibration> RunAndCrash(const v1::CalibrationInput&,
                                                         const RunnerHooks&) {
  _exit(kCrashed);
}

// A server's life: open, start, create the job (a repeat, when it is there), acknowledge it to the
// pipe, wait.
[[noreturn]] void Server(const std::string& path, const Runner& runner, int64_t crash_at,
                         int pipe) {
  auto plan = std::make_shared<store::FaultPlan>();
  plan->fault = []() -> absl::Status { _exit(kCrashed); };
  plan->fault_at = crash_at;
  const auto store = store::Store::Open({.path = path, .decorate_writer = store::Faulty(plan)});
  if (!store.ok()) _exit(2);
  JobEngine engine(**store, runner, QuickOptions());
  if (!engine.Start().ok()) _exit(3);
  const auto created = (*store)->Write([](store::Transaction& transaction) {
    return store::CreateJob(transaction, store::Uuid(1), store::SampleJob("ur10", {1}));
  });
  if (!created.ok() || write(pipe, "1", 1) != 1) _exit(4);
  engine.Wake();
  Finish(engine, kName);
  _exit(0);
}

struct Life {
  int exit_code = -1;
  bool acknowledged = false;
};

// Runs a server in a process of its own.
Life Live(const std::string& path, const Runner& runner, int64_t crash_at) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) Server(path, runner, crash_at, ends[1]);
  close(ends[1]);
  Life life;
  char said = 0;
  life.acknowledged = read(ends[0], &said, 1) == 1;
  close(ends[0]);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  if (WIFEXITED(status)) life.exit_code = WEXITSTATUS(status);
  return life;
}

class Crash : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto store = store::Store::Open({.path = prepared_});
    ASSERT_TRUE(store.ok()) << store.status();
    store::AddRobotWithSession(**store);
  }
  // A database with a robot and a session, and no job.
  void CopyPrepared() {
    std::filesystem::copy_file(prepared_, path_, std::filesystem::copy_options::overwrite_existing);
  }
  void RemoveDatabase() {
    for (const char* suffix : {"", "-wal", "-shm", ".lock"})
      std::filesystem::remove(path_ + suffix);
  }
  void ExpectOneResult(const std::string& when) {
    const auto store = store::Store::Open({.path = path_});
    ASSERT_TRUE(store.ok()) << store.status() << when;
    const v1::CalibrationJob job = Stored(**store, kName);
    EXPECT_EQ(job.state(), v1::SUCCEEDED) << when;
    EXPECT_EQ(job.calibration(), "robots/ur10/calibrations/1") << when;
    EXPECT_LE(job.attempts(), 2) << when;
    EXPECT_EQ(CalibrationCount(**store), 1) << when;
  }
  bool IsJobStored() {
    const auto store = store::Store::Open({.path = path_});
    return store.ok() &&
           (*store)
               ->Read([](store::Snapshot& snapshot) { return store::GetJob(snapshot, kName); })
               .ok();
  }

  store::TemporaryFolder folder_;
  const std::string prepared_ = folder_.Path("prepared.db");
  const std::string path_ = folder_.Path("a.db");
};

// Catches a job that is lost or run twice to an end, at whatever statement the server ended.
TEST_F(Crash, AtEachStatementOfAJobsLife) {
  int crashes = 0, acknowledged = 0;
  for (int64_t at = 1;; ++at) {
    const std::string when = " crash at statement " + std::to_string(at);
    CopyPrepared();
    const Life life = Live(path_, RunQuickly, at);
    if (life.exit_code == 0) break;
    ASSERT_EQ(life.exit_code, kCrashed) << when;
    ++crashes;
    acknowledged += life.acknowledged;
    EXPECT_TRUE(!life.acknowledged || IsJobStored()) << when;
    EXPECT_EQ(Live(path_, RunQuickly, 0).exit_code, 0) << when;
    ExpectOneResult(when);
    RemoveDatabase();
  }
  EXPECT_GT(crashes, 40) << "the crashes happened at all";
  EXPECT_GT(acknowledged, 10) << "also while the job ran";
}

// Catches a job that ends every server that takes it up.
TEST_F(Crash, AJobThatCrashesItsServerIsGivenUp) {
  CopyPrepared();
  for (int life = 1; life <= 3; ++life) EXPECT_EQ(Live(path_, RunAndCrash, 0).exit_code, kCrashed);
  EXPECT_EQ(Live(path_, RunAndCrash, 0).exit_code, 0) << "the fourth server lives on";
  const auto store = store::Store::Open({.path = path_});
  ASSERT_TRUE(store.ok()) << store.status();
  EXPECT_EQ(Stored(**store, kName).state(), v1::FAILED);
  EXPECT_EQ(Stored(**store, kName).attempts(), 3);
}

}  // namespace
}  // namespace truepose::jobs
