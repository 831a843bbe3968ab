#include "tests/store/power/store_load.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <thread>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/names.h"
#include "server/store/reading_sources.h"
#include "server/store/readings.h"
#include "server/store/resources.h"
#include "server/store/sessions.h"
#include "server/store/sql/query.h"
#include "tests/store/testing/samples.h"
#include "truepose/v1/plant.pb.h"

namespace truepose::store {
namespace {

constexpr int kSourceSession = 3;
constexpr int kMostUnderWay = 6;
constexpr char kInstrument[] = "instruments/tracker";
const ResourceKey kKey = {.kind = v1::KIND_INSTRUMENT, .robot_id = "", .id = "tracker"};

std::string Source() { return Uuid(170); }
std::string SessionOf(int number) { return SessionName(Uuid(number)); }

absl::StatusOr<int64_t> ReadRows(Snapshot& snapshot, int session) {
  TRUEPOSE_ASSIGN_OR_RETURN(const v1::Session found, GetSession(snapshot, SessionOf(session)));
  return found.reading_count();
}

absl::StatusOr<int64_t> ReadRevision(Snapshot& snapshot) {
  TRUEPOSE_ASSIGN_OR_RETURN(const auto bytes, FindResource(snapshot, kKey));
  v1::Instrument instrument;
  if (!bytes.has_value()) return 0;
  instrument.ParseFromString(*bytes);
  return std::stoll(instrument.display_name());
}

int64_t AppendRows(Store& store, int session) {
  const auto begin = store.Read([&](Snapshot& s) { return ReadRows(s, session); });
  for (int64_t stored = begin.value_or(0);;) {
    const ReadingBatch batch(SampleReadings(static_cast<int>(stored), kLoadBatch));
    const auto count =
        store.Write([&](Transaction& t) { return AppendReadings(t, SessionOf(session), batch); });
    if (!count.ok()) return stored;
    stored = *count;
  }
}

int64_t AppendSequences(Store& store) {
  std::mutex mutex;
  std::condition_variable answered;
  int under_way = 0;
  bool failed = false;
  int64_t durable =
      store.Read([](Snapshot& s) { return DurableSequence(s, Source()); }).value_or(0);
  std::unique_lock lock(mutex);
  for (int64_t next = durable + 1; !failed; next += kLoadBatch) {
    ++under_way;
    lock.unlock();
    store.WriteAsync(
        [batch = SourceBatch{Source(), next, SessionOf(kSourceSession),
                             ReadingBatch(SampleReadings(static_cast<int>(next), kLoadBatch))}](
            Transaction& t) { return AppendFromSource(t, batch); },
        [&](const absl::StatusOr<SourceProgress>& progress) {
          const std::lock_guard done(mutex);
          --under_way;
          failed = failed || !progress.ok();
          if (progress.ok()) durable = progress->durable_sequence;
          answered.notify_one();
        });
    lock.lock();
    answered.wait(lock, [&] { return under_way < kMostUnderWay; });
  }
  answered.wait(lock, [&] { return under_way == 0; });
  return durable;
}

int64_t ChangeInstrument(Store& store) {
  const auto begin = store.Read([](Snapshot& s) { return ReadRevision(s); });
  for (int64_t revision = begin.value_or(0) + 1;; ++revision) {
    v1::Instrument instrument;
    instrument.set_name(kInstrument);
    instrument.set_display_name(absl::StrCat(revision));
    const absl::Status stored = store.Write(
        [&](Transaction& t) { return PutResource(t, kKey, kInstrument, instrument, false); });
    if (!stored.ok()) return revision - 1;
  }
}

int64_t CheckRows(Store& store, int session, int first) {
  const auto readings = store.Read([&](Snapshot& s) { return AllReadings(s, SessionOf(session)); });
  EXPECT_TRUE(readings.ok()) << readings.status();
  if (!readings.ok()) return 0;
  const int count = static_cast<int>(readings->size());
  EXPECT_EQ(count % kLoadBatch, 0) << "a batch is stored in part";
  for (int row = 0; row < count; ++row) {
    v1::Reading written = SampleReading(first + row);
    written.set_row(row);
    EXPECT_EQ((*readings)[row].SerializeAsString(), written.SerializeAsString()) << "row " << row;
  }
  EXPECT_EQ(store.Read([&](Snapshot& s) { return ReadRows(s, session); }).value_or(-1), count);
  return count;
}

absl::StatusOr<std::string> Integrity(Snapshot& snapshot) {
  TRUEPOSE_ASSIGN_OR_RETURN(auto rows, snapshot.sql().Prepare("PRAGMA integrity_check(3)"));
  TRUEPOSE_RETURN_IF_ERROR(rows->Step().status());
  return rows->Text(0);
}

absl::StatusOr<int64_t> Events(Snapshot& snapshot) {
  return sql::QueryInt64(snapshot.sql(), "SELECT COUNT(*) FROM events WHERE name = $1",
                         kInstrument);
}

}  // namespace

void PrepareLoad(Store& store) {
  AddRobot(store, "ur10");
  for (int session = 1; session <= kSourceSession; ++session) AddSession(store, session, "ur10", 0);
}

LoadCounts RunLoad(Store& store) {
  LoadCounts acknowledged{};
  std::thread rows([&] { acknowledged[kRows] = AppendRows(store, 1); });
  std::thread more_rows([&] { acknowledged[kMoreRows] = AppendRows(store, 2); });
  std::thread sequences([&] { acknowledged[kSequences] = AppendSequences(store); });
  acknowledged[kRevisions] = ChangeInstrument(store);
  for (std::thread* thread : {&rows, &more_rows, &sequences}) thread->join();
  return acknowledged;
}

LoadCounts CheckLoad(Store& store) {
  const auto integrity = store.Read([](Snapshot& s) { return Integrity(s); });
  EXPECT_TRUE(integrity.ok()) << integrity.status();
  EXPECT_EQ(integrity.value_or(""), "ok");
  LoadCounts stored{};
  stored[kRows] = CheckRows(store, 1, 0);
  stored[kMoreRows] = CheckRows(store, 2, 0);
  stored[kSequences] = CheckRows(store, kSourceSession, 1);
  EXPECT_EQ(store.Read([](Snapshot& s) { return DurableSequence(s, Source()); }).value_or(-1),
            stored[kSequences]);
  stored[kRevisions] = store.Read([](Snapshot& s) { return ReadRevision(s); }).value_or(-1);
  EXPECT_EQ(store.Read([](Snapshot& s) { return Events(s); }).value_or(-1), stored[kRevisions]);
  return stored;
}

}  // namespace truepose::store
