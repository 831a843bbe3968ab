// The backends that the suite runs on, and what holds for the store as such.
#include <atomic>
#include <thread>
#include <vector>

#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "server/store/sessions.h"
#include "tests/store/conformance/conformance.h"

namespace truepose::store {
namespace {

INSTANTIATE_TEST_SUITE_P(Backends, StoreConformance,
                         ::testing::Values(Backend::kSqliteMemory, Backend::kSqliteFile),
                         [](const auto& backend) {
                           return backend.param == Backend::kSqliteMemory ? "SqliteMemory"
                                                                          : "SqliteFile";
                         });

auto CreateRobotNamed(const std::string& id) {
  return [id](Transaction& transaction) {
    return CreateRobot(transaction, id, SampleNominal(id), id);
  };
}

auto GetRobotNamed(const std::string& id) {
  return [id](Snapshot& snapshot) { return GetRobot(snapshot, RobotName(id)); };
}

// Catches a store whose failing closure leaves its writes behind.
TEST_P(StoreConformance, AFailingClosureLeavesNothingBehind) {
  const absl::Status status = Write([](Transaction& transaction) {
    EXPECT_TRUE(CreateRobotNamed("ghost")(transaction).ok());
    return absl::InvalidArgumentError("no");
  });
  EXPECT_EQ(status, absl::InvalidArgumentError("no"));
  EXPECT_EQ(Read(GetRobotNamed("ghost")).status().code(), absl::StatusCode::kNotFound);
}

// Catches a revision that stands still, or counts commits that didn't happen.
TEST_P(StoreConformance, EveryCommitHasARevisionOfItsOwn) {
  ASSERT_TRUE(Write(CreateRobotNamed("a")).ok());
  const int64_t first = *store_->Revision();
  EXPECT_EQ(Write([](Transaction&) { return absl::CancelledError(""); }).code(),
            absl::StatusCode::kCancelled);
  EXPECT_EQ(*store_->Revision(), first);
  int64_t told = 0;
  ASSERT_TRUE(Write([&](Transaction& transaction) {
                told = transaction.revision();
                return CreateRobotNamed("b")(transaction);
              }).ok());
  EXPECT_EQ(told, first + 1);
  EXPECT_EQ(*store_->Revision(), first + 1);
  EXPECT_EQ(Read(GetRobotNamed("b"))->revision(), first + 1);
}

// Catches a read that changes the store.
TEST_P(StoreConformance, WhatAReadWritesIsNeverStored) {
  Read([](Snapshot& snapshot) {
    return snapshot.sql().Execute("INSERT INTO robots (id, message) VALUES ('sneaky', x'')");
  }).IgnoreError();
  EXPECT_EQ(Read(GetRobotNamed("sneaky")).status().code(), absl::StatusCode::kNotFound);
}

// Catches a deadlock of a closure that calls the store: it is told so instead.
TEST_P(StoreConformance, AClosureMustNotCallTheStore) {
  absl::Status nested_write, nested_read;
  ASSERT_TRUE(Write([&](Transaction&) {
                nested_write = Write([](Transaction&) { return absl::OkStatus(); });
                nested_read = store_->Revision().status();
                return absl::OkStatus();
              }).ok());
  EXPECT_EQ(nested_write.code(), absl::StatusCode::kInternal);
  EXPECT_EQ(nested_read.code(), absl::StatusCode::kInternal);
  EXPECT_EQ(Read([&](Snapshot&) { return store_->Revision(); }).status().code(),
            absl::StatusCode::kInternal);
  EXPECT_TRUE(Write([](Transaction&) { return absl::OkStatus(); }).ok())
      << "the thread isn't marked for ever";
}

// Catches lost or doubled closures of writers that meet, and readers that see half a closure (the
// two robots of a closure are there both or not at all).
TEST_P(StoreConformance, ManyWritersAndReadersAtOnce) {
  constexpr int kThreads = 4, kWrites = 25;
  std::atomic<bool> writing = true;
  std::atomic<int> failures = 0;
  std::vector<std::thread> writers;
  for (int thread = 0; thread < kThreads; ++thread) {
    writers.emplace_back([&, thread] {
      for (int i = 0; i < kWrites; ++i) {
        const std::string id = "r" + std::to_string(thread) + "-" + std::to_string(i);
        const auto result = Write([&](Transaction& transaction) {
          const absl::Status left = CreateRobotNamed(id + "-left")(transaction).status();
          return left.ok() ? CreateRobotNamed(id + "-right")(transaction).status() : left;
        });
        if (!result.ok()) ++failures;
      }
    });
  }
  std::thread reader([&] {
    while (writing) {
      const auto robots = Read(
          [](Snapshot& snapshot) { return ListRobots(snapshot, {.size = 1000, .token = ""}); });
      if (!robots.ok() || robots->items.size() % 2 != 0) ++failures;
    }
  });
  for (std::thread& writer : writers) writer.join();
  writing = false;
  reader.join();
  EXPECT_EQ(failures, 0);
  EXPECT_EQ(Read([](Snapshot& snapshot) {
              return ListRobots(snapshot, {.size = 1000, .token = ""});
            })->items.size(),
            size_t{2 * kThreads * kWrites});
}

// Catches two databases that can't be told apart.
TEST_P(StoreConformance, TheEpochIsOfTheDatabase) {
  const auto other = Store::Open({.path = ":memory:"});
  ASSERT_TRUE(other.ok());
  EXPECT_EQ(store_->epoch().size(), 32u);
  EXPECT_NE(store_->epoch(), (*other)->epoch());
}

}  // namespace
}  // namespace truepose::store
