// Sessions and their readings.
#include "server/store/sessions.h"

#include "server/store/names.h"
#include "server/store/readings.h"
#include "server/store/robots.h"
#include "tests/store/conformance/conformance.h"

namespace truepose::store {
namespace {

using Readings = google::protobuf::RepeatedPtrField<v1::Reading>;

std::string Name(int number) { return SessionName(Uuid(number)); }

auto Create(int number, const v1::Session& session) {
  return
      [=](Transaction& transaction) { return CreateSession(transaction, Uuid(number), session); };
}

auto Append(int number, const Readings& readings) {
  return [=](Transaction& transaction) {
    return AppendReadings(transaction, Name(number), ReadingBatch(readings));
  };
}

auto Seal(int number, int count, const std::string& digest) {
  return [=](Transaction& transaction) {
    return SealSession(transaction, Name(number), count, digest);
  };
}

auto Get(int number) {
  return [=](Snapshot& snapshot) { return GetSession(snapshot, Name(number)); };
}

// Catches fields that aren't kept, and a session that follows later revisions of its robot.
TEST_P(StoreConformance, ASessionBelongsToTheRevisionOfItsTime) {
  AddRobot(*store_, "ur10");
  const auto created = Write(Create(1, SampleSession("ur10")));
  ASSERT_TRUE(created.ok()) << created.status();
  ASSERT_TRUE(Write([](Transaction& transaction) {
                return AddNominalRevision(transaction, "robots/ur10", SampleNominal("new"), "new");
              }).ok());
  const auto read = Read(Get(1));
  EXPECT_EQ(read->SerializeAsString(), created->SerializeAsString());
  EXPECT_EQ(read->name(), Name(1));
  EXPECT_EQ(read->nominal_revision(), "robots/ur10/nominals/1");
  EXPECT_EQ(read->extra_columns(0), "operator");
  EXPECT_EQ(read->state(), v1::OPEN);
  EXPECT_EQ(read->create_time().seconds(), absl::ToUnixSeconds(clock_.Now()));
  EXPECT_EQ(Write(Create(2, SampleSession("ur10")))->nominal_revision(), "robots/ur10/nominals/2");
}

// Catches a retry that fails, and other values that are taken for a retry.
TEST_P(StoreConformance, ARepeatedCreateOfASession) {
  AddRobot(*store_, "ur10");
  AddRobot(*store_, "panda");
  v1::Session session = SampleSession("ur10");
  const auto first = Write(Create(1, session));
  EXPECT_EQ(Write(Create(1, session))->SerializeAsString(), first->SerializeAsString());
  for (auto change : {+[](v1::Session& s) { s.set_display_name("other"); },
                      +[](v1::Session& s) { s.set_source("x"); },
                      +[](v1::Session& s) { s.add_extra_columns("more"); },
                      +[](v1::Session& s) { s.set_robot("robots/panda"); }}) {
    v1::Session changed = session;
    change(changed);
    EXPECT_EQ(Write(Create(1, changed)).status().code(), absl::StatusCode::kAlreadyExists);
  }
}

// Catches a session of nothing, or of another robot's revision.
TEST_P(StoreConformance, ASessionNeedsItsRobot) {
  AddRobot(*store_, "ur10");
  AddRobot(*store_, "panda");
  const auto unknown = Write(Create(1, SampleSession("none")));
  EXPECT_EQ(unknown.status().code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(FaultFields(unknown.status()), std::vector<std::string>{"session.robot"});
  v1::Session crossed = SampleSession("ur10");
  crossed.set_nominal_revision("robots/panda/nominals/1");
  const auto wrong = Write(Create(1, crossed));
  EXPECT_EQ(wrong.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultFields(wrong.status()), std::vector<std::string>{"session.nominal_revision"});
  EXPECT_EQ(Write([](Transaction& transaction) {
              return CreateSession(transaction, "not-a-uuid", SampleSession("ur10"));
            })
                .status()
                .code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(Read(Get(1)).status().code(), absl::StatusCode::kNotFound);
}

// Catches readings that are lost, reordered or changed, and a wrong count.
TEST_P(StoreConformance, ReadingsComeBackAsTheyWere) {
  AddRobot(*store_, "ur10");
  ASSERT_TRUE(Write(Create(1, SampleSession("ur10"))).ok());
  EXPECT_EQ(*Write(Append(1, SampleReadings(0, 3))), 3);
  EXPECT_EQ(*Write(Append(1, SampleReadings(3, 2))), 5);
  EXPECT_EQ(*Write(Append(1, {})), 5);
  EXPECT_EQ(Read(Get(1))->reading_count(), 5);
  const auto all = Read([](Snapshot& snapshot) { return AllReadings(snapshot, Name(1)); });
  ASSERT_EQ(all->size(), 5u);
  for (int row = 0; row < 5; ++row)
    EXPECT_EQ((*all)[row].SerializeAsString(), SampleReading(row).SerializeAsString());
}

// Catches a resend that is refused or stored twice: batches that repeat, overlap, or come after
// sealing.
TEST_P(StoreConformance, TheSameRowsAreAcceptedAgain) {
  AddRobot(*store_, "ur10");
  ASSERT_TRUE(Write(Create(1, SampleSession("ur10"))).ok());
  ASSERT_TRUE(Write(Append(1, SampleReadings(0, 4))).ok());
  EXPECT_EQ(*Write(Append(1, SampleReadings(0, 4))), 4);
  EXPECT_EQ(*Write(Append(1, SampleReadings(1, 2))), 4);
  EXPECT_EQ(*Write(Append(1, SampleReadings(2, 4))), 6) << "two old rows, two new ones";
  ASSERT_TRUE(Write(Seal(1, 6, "digest")).ok());
  EXPECT_EQ(*Write(Append(1, SampleReadings(0, 6))), 6) << "nothing new after sealing";
  EXPECT_EQ(Read([](Snapshot& snapshot) { return AllReadings(snapshot, Name(1)); })->size(), 6u);
}

// Catches a batch of which a part is stored, an overwritten row, and a message that names only the
// first.
TEST_P(StoreConformance, ContradictingRowsAbortTheWholeBatch) {
  AddRobot(*store_, "ur10");
  ASSERT_TRUE(Write(Create(1, SampleSession("ur10"))).ok());
  ASSERT_TRUE(Write(Append(1, SampleReadings(0, 3))).ok());
  Readings batch = SampleReadings(0, 5);
  batch[0].set_target("other");
  batch[2].set_target("other");
  const auto result = Write(Append(1, batch));
  EXPECT_EQ(result.status().code(), absl::StatusCode::kAborted);
  EXPECT_EQ(FaultFields(result.status()),
            (std::vector<std::string>{"readings[0].row", "readings[2].row"}));
  const auto all = Read([](Snapshot& snapshot) { return AllReadings(snapshot, Name(1)); });
  ASSERT_EQ(all->size(), 3u);
  EXPECT_EQ((*all)[0].target(), "");
}

// Catches holes in a session: before a batch, within one, and negative rows.
TEST_P(StoreConformance, AGapIsOutOfRange) {
  AddRobot(*store_, "ur10");
  ASSERT_TRUE(Write(Create(1, SampleSession("ur10"))).ok());
  ASSERT_TRUE(Write(Append(1, SampleReadings(0, 2))).ok());
  EXPECT_EQ(Write(Append(1, SampleReadings(3, 1))).status().code(), absl::StatusCode::kOutOfRange);
  EXPECT_EQ(Write(Append(1, SampleReadings(-1, 1))).status().code(), absl::StatusCode::kOutOfRange);
  Readings holes = SampleReadings(2, 4);
  holes[1].set_row(7);
  holes[3].set_row(2);
  const auto result = Write(Append(1, holes));
  EXPECT_EQ(result.status().code(), absl::StatusCode::kOutOfRange);
  EXPECT_EQ(FaultFields(result.status()),
            (std::vector<std::string>{"readings[1].row", "readings[3].row"}));
  EXPECT_EQ(Read(Get(1))->reading_count(), 2);
  EXPECT_EQ(Write(Append(9, SampleReadings(0, 1))).status().code(), absl::StatusCode::kNotFound);
}

// Catches a session that is sealed with readings missing, changed after it, or sealed as two
// different things.
TEST_P(StoreConformance, ASealedSessionNeverChanges) {
  AddRobot(*store_, "ur10");
  ASSERT_TRUE(Write(Create(1, SampleSession("ur10"))).ok());
  EXPECT_EQ(Write(Seal(1, 0, "none")).status().code(), absl::StatusCode::kFailedPrecondition)
      << "no readings";
  ASSERT_TRUE(Write(Append(1, SampleReadings(0, 2))).ok());
  const auto short_by_one = Write(Seal(1, 3, "digest"));
  EXPECT_EQ(short_by_one.status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(FaultFields(short_by_one.status()), std::vector<std::string>{"reading_count"});
  EXPECT_EQ(Write(Seal(1, 1, "digest")).status().code(), absl::StatusCode::kFailedPrecondition)
      << "more than the client knows of";
  clock_.Advance(absl::Minutes(5));
  const auto sealed = Write(Seal(1, 2, "digest"));
  ASSERT_TRUE(sealed.ok()) << sealed.status();
  EXPECT_EQ(sealed->state(), v1::SEALED);
  EXPECT_EQ(sealed->seal_time().seconds(), absl::ToUnixSeconds(clock_.Now()));
  clock_.Advance(absl::Minutes(5));
  EXPECT_EQ(Write(Seal(1, 2, "digest"))->SerializeAsString(), sealed->SerializeAsString())
      << "a repeat";
  EXPECT_EQ(Write(Seal(1, 2, "other")).status().code(), absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(Write(Append(1, SampleReadings(2, 1))).status().code(),
            absl::StatusCode::kFailedPrecondition);
  EXPECT_EQ(Read(Get(1))->SerializeAsString(), sealed->SerializeAsString());
}

// Catches lists that mix robots up, aren't newest first, or lose their place when sessions are
// added.
TEST_P(StoreConformance, ListsOfSessions) {
  AddRobot(*store_, "ur10");
  AddRobot(*store_, "panda");
  for (int number = 1; number <= 5; ++number) {
    ASSERT_TRUE(Write(Create(number, SampleSession(number == 3 ? "panda" : "ur10"))).ok());
  }
  const auto list = [&](const std::string& robot, const PageRequest& request) {
    return Read([&](Snapshot& snapshot) { return ListSessions(snapshot, robot, request); });
  };
  EXPECT_EQ(list("", {})->items.size(), 5u);
  const auto first = list("robots/ur10", {.size = 2, .token = ""});
  ASSERT_EQ(first->items.size(), 2u);
  EXPECT_EQ(first->items[0].name(), Name(5));
  EXPECT_EQ(first->items[1].name(), Name(4));
  ASSERT_TRUE(Write(Create(6, SampleSession("ur10"))).ok());
  const auto second = list("robots/ur10", {.size = 2, .token = first->next_page_token});
  ASSERT_EQ(second->items.size(), 2u);
  EXPECT_EQ(second->items[0].name(), Name(2));
  EXPECT_EQ(second->next_page_token, "");
  EXPECT_EQ(list("robots/panda", {.size = 2, .token = first->next_page_token}).status().code(),
            absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(list("robots/none", {}).status().code(), absl::StatusCode::kNotFound);
}

// Catches a time of the client, of the commit before, or one that changes when a reading is sent
// again.
TEST_P(StoreConformance, ReadingsKeepTheTimeTheyCame) {
  AddRobot(*store_, "ur10");
  AddSession(*store_, 1, "ur10", 1);
  const int64_t first = absl::ToUnixSeconds(clock_.Now());
  clock_.Advance(absl::Minutes(5));
  Readings again = SampleReadings(0, 2);
  again[0].mutable_server_time()->set_seconds(1);
  again[1].mutable_server_time()->set_seconds(1);
  ASSERT_TRUE(Write(Append(1, again)).ok());
  const auto page = Read([](Snapshot& snapshot) { return ListReadings(snapshot, Name(1), {}); });
  ASSERT_EQ(page->items.size(), 2u);
  EXPECT_EQ(page->items[0].server_time().seconds(), first);
  EXPECT_EQ(page->items[1].server_time().seconds(), first + 300);
}

// Catches pages of readings that overlap or leave rows out.
TEST_P(StoreConformance, PagesOfReadings) {
  AddRobot(*store_, "ur10");
  AddSession(*store_, 1, "ur10", 25);
  PageRequest request{.size = 10, .token = ""};
  std::vector<int> rows;
  do {
    const auto page =
        Read([&](Snapshot& snapshot) { return ListReadings(snapshot, Name(1), request); });
    ASSERT_TRUE(page.ok()) << page.status();
    for (const v1::Reading& reading : page->items) rows.push_back(reading.row());
    request.token = page->next_page_token;
  } while (!request.token.empty());
  ASSERT_EQ(rows.size(), 25u);
  for (int row = 0; row < 25; ++row) EXPECT_EQ(rows[row], row);
}

}  // namespace
}  // namespace truepose::store
