// A process that writes is ended by kill -9 at random moments. What it was told is stored must be
// there afterwards, whole. This proves the death of a process only: what the system had taken is
// still written, as after a power loss it would not be.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/sessions.h"
#include "server/store/store.h"
#include "tests/store/testing/samples.h"
#include "tests/store/testing/temporary_folder.h"

namespace truepose::store {
namespace {

constexpr int kRounds = 36;
constexpr int kSessions = 3;  // each with a thread of its own, so that commits are shared
constexpr int kBatch = 7;

// What the child tells: so many readings of the session are acknowledged.
struct Acknowledged {
  int session;
  int readings;
};

void AppendForEver(Store& store, int session, int pipe) {
  const std::string name = SessionName(Uuid(session));
  int stored =
      store.Read([&](Snapshot& snapshot) { return GetSession(snapshot, name); })->reading_count();
  for (;;) {
    const auto count = store.Write([&](Transaction& transaction) {
      return AppendReadings(transaction, name, ReadingBatch(SampleReadings(stored, kBatch)));
    });
    if (!count.ok()) _exit(3);
    stored = *count;
    const Acknowledged told{session, stored};
    if (write(pipe, &told, sizeof(told)) != sizeof(told)) _exit(4);
  }
}

[[noreturn]] void Child(const std::string& path, int pipe) {
  const auto store = Store::Open({.path = path});
  if (!store.ok()) _exit(2);
  std::vector<std::thread> threads;
  for (int session = 1; session <= kSessions; ++session) {
    threads.emplace_back([&, session] { AppendForEver(**store, session, pipe); });
  }
  for (std::thread& thread : threads) thread.join();
  _exit(0);
}

// Runs a child for so long and kills it. Raises `acknowledged` by what it has told.
void RunAndKill(const std::string& path, int microseconds,
                std::array<int, kSessions + 1>& acknowledged) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) Child(path, ends[1]);
  close(ends[1]);
  usleep(microseconds);
  kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status)) << "it ended by itself with " << WEXITSTATUS(status);
  Acknowledged told;
  while (read(ends[0], &told, sizeof(told)) == sizeof(told))
    acknowledged[told.session] = told.readings;
  close(ends[0]);
}

void ExpectSession(Store& store, int session, int acknowledged) {
  const std::string name = SessionName(Uuid(session));
  const auto readings = store.Read([&](Snapshot& snapshot) { return AllReadings(snapshot, name); });
  ASSERT_TRUE(readings.ok()) << readings.status();
  const int count = static_cast<int>(readings->size());
  EXPECT_GE(count, acknowledged) << "an acknowledged batch is lost";
  EXPECT_EQ(count % kBatch, 0) << "a batch is stored in part";
  EXPECT_EQ(
      store.Read([&](Snapshot& snapshot) { return GetSession(snapshot, name); })->reading_count(),
      count);
  for (int row = 0; row < count; ++row) {
    ASSERT_EQ((*readings)[row].SerializeAsString(), SampleReading(row).SerializeAsString());
  }
}

TEST(Kill, WhatWasAcknowledgedIsThereAndWhole) {
  TemporaryFolder folder;
  const std::string path = folder.Path("a.db");
  {
    const auto store = Store::Open({.path = path});
    ASSERT_TRUE(store.ok()) << store.status();
    AddRobot(**store, "ur10");
    for (int session = 1; session <= kSessions; ++session) AddSession(**store, session, "ur10", 0);
  }
  std::mt19937 random(20260131);
  std::uniform_int_distribution<int> microseconds(2000, 60000);
  std::array<int, kSessions + 1> acknowledged{};
  for (int round = 0; round < kRounds; ++round) {
    RunAndKill(path, microseconds(random), acknowledged);
    const auto store = Store::Open({.path = path});
    ASSERT_TRUE(store.ok()) << store.status();
    for (int session = 1; session <= kSessions; ++session)
      ExpectSession(**store, session, acknowledged[session]);
  }
  EXPECT_GT(acknowledged[1], 10 * kBatch) << "the children wrote at all";
}

}  // namespace
}  // namespace truepose::store
