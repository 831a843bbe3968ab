// The process is ended at each named place around the commits of jobs (server/jobs/failpoints.h),
// and a server is started again over the same file. Each job then has exactly one end, one result
// at most, and as many attempts as it was begun; what was acknowledged holds. As crash_test, this
// proves the death of a process, not a power loss. With TRUEPOSE_LONG the second server is ended,
// too, at each place, and each place is also taken at its second and third passing.
#include "server/jobs/failpoints.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "absl/strings/str_cat.h"
#include "server/jobs/engine.h"
#include "server/jobs/transitions.h"
#include "server/store/calibrations.h"
#include "server/store/checksum.h"
#include "server/store/compensation_tables.h"
#include "server/store/files.h"
#include "server/store/jobs.h"
#include "server/store/names.h"
#include "tests/jobs/engine_testing.h"
#include "tests/store/testing/samples.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::jobs {
namespace {

constexpr int kCrashed = 99;
constexpr int kJobs = 5;   // the last one is cancelled by each server
constexpr int kTable = 4;  // it builds a compensation table
const std::string kCancelled = store::JobName(store::Uuid(kJobs));

std::string Name(int number) { return store::JobName(store::Uuid(number)); }

// Where a server ends: at the given passing of a place; passing 0 = it lives on.
struct End {
  std::string_view point;
  int passing = 0;
};

absl::StatusOr<v1::Calibration> Calibrate(const v1::CalibrationInput& input,
                                          const RunnerHooks& hooks) {
  v1::JobProgress progress;
  progress.set_fraction(0.5);
  hooks.on_progress(progress);
  v1::Calibration calibration = store::SampleCalibration();
  for (const v1::SessionInput& session : input.sessions())
    calibration.add_sessions(session.session().name());
  return calibration;
}

std::string TableBytes() { return std::string(3 * store::kPieceBytes / 2, 't'); }

absl::StatusOr<BuiltTable> BuildTable(const v1::CompensationTableInput& input,
                                      const RunnerHooks& hooks) {
  v1::JobProgress progress;
  progress.set_fraction(0.5);
  hooks.on_progress(progress);
  BuiltTable built{TableBytes(), {}};
  built.header.set_calibration(input.calibration().name());
  return built;
}

EngineOptions OptionsWith(const End& end) {
  EngineOptions options = QuickOptions();
  options.max_attempts = 9;  // more than lives: giving up has its own test
  auto passed = std::make_shared<std::atomic<int>>(0);
  options.at_point = [end, passed](std::string_view point) {
    if (point == end.point && ++*passed == end.passing) _exit(kCrashed);
  };
  return options;
}

// A server's life: open, cancel one job and tell the pipe, take up and run the others, wait.
[[noreturn]] void Server(const std::string& path, const End& end, int pipe) {
  const auto store = store::Store::Open({.path = path});
  if (!store.ok()) _exit(2);
  JobEngine engine(**store, Runners(Calibrate, BuildTable, {}), OptionsWith(end));
  if (!engine.Cancel(kCancelled).ok() || write(pipe, "1", 1) != 1) _exit(3);
  if (!engine.Start().ok()) _exit(4);
  for (int number = 1; number <= kJobs; ++number) Finish(engine, Name(number));
  engine.Stop();
  _exit(0);
}

class Failpoints : public ::testing::Test {
 protected:
  // Two robots; a job that a dead server left RUNNING, three that wait, one of which builds a table
  // of a calibration that is there, and one to be cancelled.
  void SetUp() override {
    const auto store = store::Store::Open({.path = prepared_});
    ASSERT_TRUE(store.ok()) << store.status();
    store::AddRobotWithSession(**store);
    store::AddRobot(**store, "other");
    store::AddSealedSession(**store, 2, "other", 3);
    store::AddJob(**store, 1);
    ASSERT_TRUE((*store)
                    ->Write([](store::Transaction& transaction) { return ClaimNext(transaction); })
                    .ok());
    store::AddJob(**store, 2);
    store::AddJob(**store, 3, "other", {2});
    store::AddTableJob(**store, kTable, store::AddCalibration(**store, 9, "other", 2), "other");
    store::AddJob(**store, kJobs);
  }

  // Runs a server in a process of its own. @returns its exit code.
  int Live(const End& end) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) Server(path_, end, ends[1]);
    close(ends[1]);
    char said = 0;
    cancel_acknowledged_ |= read(ends[0], &said, 1) == 1;
    close(ends[0]);
    int status = 0;
    EXPECT_EQ(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

  // Looks at what a dead server left: nothing half, and nothing changed that had ended.
  void Inspect(const std::string& when) {
    const auto store = store::Store::Open({.path = path_});
    ASSERT_TRUE(store.ok()) << store.status() << when;
    int results = 0;
    for (int number = 1; number <= kJobs; ++number) {
      const v1::CalibrationJob job = Stored(**store, Name(number));
      EXPECT_EQ(job.calibration().empty(), job.state() != v1::SUCCEEDED) << when;
      results += job.state() == v1::SUCCEEDED && number != kTable;
      const std::string before = std::exchange(ended_[number], "");
      if (!before.empty()) {
        EXPECT_EQ(job.SerializeAsString(), before) << when;
      }
      const bool is_over = job.state() != v1::PENDING && job.state() != v1::RUNNING;
      if (is_over) ended_[number] = job.SerializeAsString();
      // It is begun once more, unless it is over or the server that took it up stopped in time.
      attempts_[number] = job.attempts() + (is_over || number == kJobs ? 0 : 1);
    }
    EXPECT_EQ(Calibrations(**store), 1 + results) << when << ": each result has its job";
    InspectTable(**store, when);
    const v1::CalibrationJob cancelled = Stored(**store, kCancelled);
    EXPECT_TRUE(!cancel_acknowledged_ || cancelled.state() == v1::CANCELLED) << when;
  }

  // Its file is there whole exactly when it is READY, and it is READY exactly when its job has
  // SUCCEEDED.
  void InspectTable(store::Store& store, const std::string& when) {
    const v1::CalibrationJob job = Stored(store, Name(kTable));
    const auto table = store.Read([&](store::Snapshot& snapshot) {
      return store::GetTable(snapshot, job.compensation_table());
    });
    ASSERT_TRUE(table.ok()) << table.status() << when;
    EXPECT_EQ(table->state() == v1::TABLE_READY, job.state() == v1::SUCCEEDED) << when;
    const std::string sha256 = store::Sha256Hex(TableBytes());
    std::string bytes;
    for (int64_t position = 0; position < 2; ++position) {
      bytes += store
                   .Read([&](store::Snapshot& snapshot) {
                     return store::ReadPiece(snapshot, sha256, position);
                   })
                   .value_or("");
    }
    EXPECT_EQ(bytes, job.state() == v1::SUCCEEDED ? TableBytes() : "") << when;
    EXPECT_EQ(table->sha256(), job.state() == v1::SUCCEEDED ? sha256 : "") << when;
  }

  void ExpectEnds(const std::string& when) {
    const auto store = store::Store::Open({.path = path_});
    ASSERT_TRUE(store.ok()) << store.status() << when;
    for (int number = 1; number <= kJobs; ++number) {
      const v1::CalibrationJob job = Stored(**store, Name(number));
      EXPECT_EQ(job.state(), number == kJobs ? v1::CANCELLED : v1::SUCCEEDED) << when;
      EXPECT_EQ(job.attempts(), attempts_[number]) << job.name() << when;
      if (!ended_[number].empty()) {
        EXPECT_EQ(job.SerializeAsString(), ended_[number]) << when;
      }
    }
    EXPECT_EQ(Calibrations(**store), kJobs - 1) << when;
  }

  // One database from the first server to the last. @returns how many servers were ended.
  int Play(const std::vector<End>& ends) {
    for (const char* suffix : {"", "-wal", "-shm", ".lock"})
      std::filesystem::remove(path_ + suffix);
    std::filesystem::copy_file(prepared_, path_);
    ended_.clear();
    cancel_acknowledged_ = false;
    std::string when;
    int crashes = 0;
    for (const End& end : ends) {
      when = absl::StrCat(when, " ended at ", std::string(end.point), ", passing ", end.passing);
      const int code = Live(end);
      EXPECT_TRUE(code == kCrashed || code == 0) << code << when;
      crashes += code == kCrashed;
      Inspect(when);
    }
    EXPECT_EQ(Live({}), 0) << when;
    ExpectEnds(when);
    return crashes;
  }

  static int Calibrations(store::Store& store) {
    int count = 0;
    for (const char* robot : {"robots/ur10", "robots/other"}) {
      const auto page = store.Read([&](store::Snapshot& snapshot) {
        return store::ListCalibrations(snapshot, robot, {.size = 1000, .token = ""});
      });
      EXPECT_TRUE(page.ok()) << page.status();
      if (page.ok()) count += static_cast<int>(page->items.size());
    }
    return count;
  }

  store::TemporaryFolder folder_;
  const std::string prepared_ = folder_.Path("prepared.db");
  const std::string path_ = folder_.Path("a.db");
  std::map<int, std::string> ended_;  // jobs that were over, as they were
  std::map<int, int> attempts_;       // that each job has at its end
  bool cancel_acknowledged_ = false;
};

bool IsLongRun() { return std::getenv("TRUEPOSE_LONG") != nullptr; }

// Catches a job that is lost, ends twice or not at all, or a result without its job, wherever the
// server ends; and a place of the list that nothing passes.
TEST_F(Failpoints, EachJobEndsExactlyOnce) {
  for (const std::string_view point : kFailpoints) {
    EXPECT_EQ(Play({{point, 1}}), 1) << std::string(point) << " is passed";
  }
}

// The same with two deaths, and at later passings. Short: the second server dies at the same place.
TEST_F(Failpoints, AlsoWhenTheNextServerEndsToo) {
  for (const std::string_view first : kFailpoints) {
    for (const std::string_view second : kFailpoints) {
      if (second != first && !IsLongRun()) continue;
      for (int passing = 1; passing <= (IsLongRun() ? 3 : 1); ++passing)
        EXPECT_LE(Play({{first, passing}, {second, 1}}), 2);
    }
  }
}

}  // namespace
}  // namespace truepose::jobs
