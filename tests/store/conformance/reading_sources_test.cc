// Readings addressed by source and sequence.
#include "server/store/reading_sources.h"

#include "core/base/error_metadata.h"
#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/sessions.h"
#include "tests/store/conformance/conformance.h"

namespace truepose::store {
namespace {

using Fields = std::vector<std::string>;

constexpr char kSource[] = "00000000-0000-4000-8000-0000000000aa";

std::string Name(int number) { return SessionName(Uuid(number)); }

// Readings that tell their sequence, as the spool of a client numbers them.
SourceBatch Spooled(int session, int first, int count, const std::string& source = kSource) {
  return {source, first, Name(session), ReadingBatch(SampleReadings(first, count))};
}

class ReadingSources : public StoreConformance {
 protected:
  void SetUp() override {
    StoreConformance::SetUp();
    AddRobot(*store_, "ur10");
    AddSession(*store_, 1, "ur10", 0);
    AddSession(*store_, 2, "ur10", 0);
  }

  absl::StatusOr<SourceProgress> Append(const SourceBatch& batch) {
    return Write([&](Transaction& transaction) { return AppendFromSource(transaction, batch); });
  }
  int64_t Durable(const std::string& source = kSource) {
    return *Read([&](Snapshot& snapshot) { return DurableSequence(snapshot, source); });
  }
  // Of a session, the sequences of its readings in the order of their rows.
  std::vector<int> Sequences(int session) {
    const auto all = Read([&](Snapshot& snapshot) { return AllReadings(snapshot, Name(session)); });
    std::vector<int> sequences;
    for (const v1::Reading& reading : *all) {
      EXPECT_EQ(reading.row(), static_cast<int>(sequences.size())) << "rows are the server's";
      sequences.push_back(static_cast<int>(reading.position_m().x() - 1));
    }
    return sequences;
  }
  void Seal(int session, int count) {
    ASSERT_TRUE(Write([&](Transaction& transaction) {
                  return SealSession(transaction, Name(session), count, "digest");
                }).ok());
  }
};

// Catches rows that come from the sequence, or a progress that lags behind the readings.
TEST_P(ReadingSources, TheServerGivesTheRows) {
  EXPECT_EQ(Durable(), 0);
  auto progress = Append(Spooled(1, 1, 3));
  ASSERT_TRUE(progress.ok()) << progress.status();
  EXPECT_EQ(progress->reading_count, 3);
  EXPECT_EQ(progress->durable_sequence, 3);
  progress = Append(Spooled(1, 4, 2));
  EXPECT_EQ(progress->reading_count, 5);
  EXPECT_EQ(progress->durable_sequence, 5);
  EXPECT_EQ(Durable(), 5);
  EXPECT_EQ(Sequences(1), (std::vector<int>{1, 2, 3, 4, 5}));
}

// Catches replays that are stored twice or refused: whole, overlapping, and across runs.
TEST_P(ReadingSources, RepeatsHaveNoEffect) {
  for (const auto& [session, first, count] :
       {std::tuple{1, 1, 4}, std::tuple{2, 5, 3}, std::tuple{1, 8, 2}}) {
    for (int replay = 0; replay < 3; ++replay) {
      const auto progress = Append(Spooled(session, first, count));
      ASSERT_TRUE(progress.ok()) << progress.status();
      EXPECT_EQ(progress->durable_sequence, first + count - 1);
    }
  }
  EXPECT_EQ(Append(Spooled(1, 2, 2))->durable_sequence, 9) << "acked as far as all is stored";
  EXPECT_EQ(Append(Spooled(1, 9, 3))->durable_sequence, 11) << "one old reading, two new ones";
  EXPECT_EQ(Sequences(1), (std::vector<int>{1, 2, 3, 4, 8, 9, 10, 11}));
  EXPECT_EQ(Sequences(2), (std::vector<int>{5, 6, 7}));
}

// Catches a run that is taken for one although rows of another way came in between.
TEST_P(ReadingSources, RowsInBetweenBreakARun) {
  ASSERT_TRUE(Append(Spooled(1, 1, 2)).ok());
  ASSERT_TRUE(Write([&](Transaction& transaction) {
                return AppendReadings(transaction, Name(1), ReadingBatch(SampleReadings(2, 1)));
              }).ok());
  ASSERT_TRUE(Append(Spooled(1, 3, 2)).ok());
  for (int replay = 0; replay < 2; ++replay) {
    const auto progress = Append(Spooled(1, 1, 4));
    ASSERT_TRUE(progress.ok()) << progress.status();
    EXPECT_EQ(progress->reading_count, 5);
  }
  EXPECT_EQ(Sequences(1), (std::vector<int>{1, 2, 2, 3, 4}));
}

// Catches another reading that passes for a stored one, in whole or for its session.
TEST_P(ReadingSources, OtherContentIsAborted) {
  ASSERT_TRUE(Append(Spooled(1, 1, 3)).ok());
  ASSERT_TRUE(Append(Spooled(2, 4, 2)).ok());
  auto readings = SampleReadings(2, 4);
  readings[1].set_target("other");
  const auto other = Append({kSource, 2, Name(1), ReadingBatch(readings)});
  EXPECT_EQ(other.status().code(), absl::StatusCode::kAborted);
  EXPECT_EQ(FaultFields(other.status()),
            (Fields{"readings[1].sequence", "readings[2].sequence", "readings[3].sequence"}))
      << "one of another content, two of another session";
  EXPECT_EQ(Durable(), 5);
  EXPECT_EQ(Sequences(1).size(), 3u);
}

// Catches holes, and a client that is told of one without where to go on.
TEST_P(ReadingSources, AGapSaysWhatIsExpected) {
  ASSERT_TRUE(Append(Spooled(1, 1, 3)).ok());
  for (int first : {5, 100, 0}) {
    const auto gap = Append(Spooled(1, first, 2));
    EXPECT_EQ(gap.status().code(), absl::StatusCode::kOutOfRange);
    EXPECT_EQ(FaultFields(gap.status()), Fields{"first_sequence"});
    EXPECT_EQ(ErrorMetadataOf(gap.status()), (ErrorMetadata{{"expected_sequence", "4"}}));
  }
  EXPECT_EQ(Append(Spooled(1, 2, 1, Uuid(77))).status().code(), absl::StatusCode::kOutOfRange)
      << "a source begins with 1";
  EXPECT_EQ(Sequences(1).size(), 3u);
}

// Catches sources that are mixed up in a session that they share.
TEST_P(ReadingSources, SourcesCountForThemselves) {
  const std::string other = Uuid(77);
  ASSERT_TRUE(Append(Spooled(1, 1, 2)).ok());
  ASSERT_TRUE(Append(Spooled(1, 1, 3, other)).ok());
  ASSERT_TRUE(Append(Spooled(1, 3, 1)).ok());
  EXPECT_EQ(Append(Spooled(1, 1, 3, other))->reading_count, 6);
  EXPECT_EQ(Durable(), 3);
  EXPECT_EQ(Durable(other), 3);
  EXPECT_EQ(Sequences(1), (std::vector<int>{1, 2, 1, 2, 3, 3}));
}

// Catches a client that hangs for ever because its last answer was lost before the session was
// sealed.
TEST_P(ReadingSources, ASealedSessionTakesRepeatsOnly) {
  ASSERT_TRUE(Append(Spooled(1, 1, 3)).ok());
  Seal(1, 3);
  EXPECT_EQ(Append(Spooled(1, 1, 3))->durable_sequence, 3);
  const auto more = Append(Spooled(1, 3, 2));
  EXPECT_EQ(more.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(FaultFields(more.status()), Fields{"session"});
  EXPECT_EQ(Durable(), 3);
}

// Catches a restored server that takes readings of a session it has lost, or doesn't say so.
TEST_P(ReadingSources, AnUnknownSessionIsNamed) {
  const auto unknown = Append(Spooled(9, 1, 1));
  EXPECT_EQ(unknown.status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(FaultFields(unknown.status()), Fields{"session"});
  EXPECT_NE(std::string(unknown.status().message()).find("create it"), std::string::npos);
  EXPECT_EQ(Durable(), 0);
}

// Catches a reading whose bytes depend on who wrote them: then the same one sent again would be
// another. Rows around the lengths of a varint, and a time that clients may not set.
TEST(ReadingBatch, BytesAreTheMessagesOwn) {
  std::string buffer;
  for (int row : {0, 1, 127, 128, 16383, 16384, 2097151, 2147483647}) {
    auto readings = SampleReadings(3, 2);
    readings[1].set_row(1 << 20);
    readings[1].mutable_server_time()->set_seconds(5);
    const ReadingBatch batch(readings);
    for (int i : {0, 1}) {
      readings[i].set_row(row);
      readings[i].clear_server_time();
      EXPECT_EQ(batch.Encoded(i, row, buffer), readings[i].SerializeAsString()) << row;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sqlite, ReadingSources,
                         ::testing::Values(Backend::kSqliteMemory, Backend::kSqliteFile));

}  // namespace
}  // namespace truepose::store
