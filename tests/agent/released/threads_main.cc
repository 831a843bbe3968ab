// Four threads correct joints by what runs while it is swapped a thousand times. Built with the
// thread sanitizer, which ends it with an error on anything that two threads see half done; checks
// besides that name, table and joints belong together.
#include <atomic>
#include <cstdio>
#include <thread>
#include <vector>

#include "client/agent/released/released_store.h"
#include "compensation/correct_by_table.h"
#include "tests/agent/released/test_table.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::agent {
namespace {

constexpr int kReaders = 4, kSwaps = 1'000;
constexpr compensation::JointArray kJoints = {0.1, -1.2, 1.3, -1.6, -1.5, 0.2};

// Both are on the disk, and each is swapped for the other.
int Swap(ReleasedStore& store, testing::TestTable (&tables)[2]) {
  int failed = 0;
  for (int swap = 0; swap < kSwaps; ++swap) {
    testing::TestTable& next = tables[swap % 2];
    next.entry.activated_us = 1'790'000'000'000'000 + swap;
    failed += !store.Offer(next.entry, [&] { return next.bytes; }).ok();
  }
  return failed;
}

bool IsWhole(const ReleasedState& state, const testing::TestTable (&tables)[2],
             const compensation::JointArray (&expected)[2]) {
  const int which =
      state.current->entry().calibration == tables[0].content.header.calibration.view() ? 0 : 1;
  return compensation::CorrectByTable(state.current->table(), kJoints.data()).q == expected[which];
}

int Main() {
  const truepose::testing::TempDir folder;
  Disk disk;
  ReleasedStore store(ReleasedCache(folder.File("arm"), "robots/arm", disk),
                      [](const std::string&) {});
  testing::TestTable tables[] = {testing::TestTable(1), testing::TestTable(2)};
  compensation::JointArray expected[2];
  for (int i = 0; i < 2; ++i)
    expected[i] =
        compensation::CorrectByTable(compensation::MakeTable(tables[i].content), kJoints.data()).q;
  if (!store.Offer(tables[0].entry, [&] { return tables[0].bytes; }).ok()) return 1;
  std::atomic<bool> ended{false};
  std::atomic<int> wrong{0};
  std::vector<std::thread> readers;
  for (int reader = 0; reader < kReaders; ++reader)
    readers.emplace_back([&] {
      while (!ended) wrong += !IsWhole(*store.state(), tables, expected);
    });
  const int failed = Swap(store, tables);
  ended = true;
  for (std::thread& reader : readers) reader.join();
  std::printf("%d swaps: %d failed, %d read wrongly\n", kSwaps, failed, wrong.load());
  return failed + wrong == 0 && expected[0] != expected[1] ? 0 : 1;
}

}  // namespace
}  // namespace truepose::agent

int main() { return truepose::agent::Main(); }
