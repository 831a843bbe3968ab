// The history of changes and the kept answers, on every backend.
#include "server/store/events.h"

#include "server/store/replies.h"
#include "server/store/robots.h"
#include "tests/store/conformance/conformance.h"

namespace truepose::store {
namespace {

constexpr int kAll = 1'000;
constexpr int64_t kManyBytes = 1'000'000;

v1::AgentReport Report(const std::string& name) {
  v1::AgentReport report;
  report.set_name(name);
  return report;
}

absl::Status Record(Transaction& transaction, const std::string& robot, const std::string& name) {
  return RecordEvent(transaction, {.kind = v1::KIND_AGENT_REPORT, .robot_id = robot, .name = name},
                     Report(name));
}

class EventsTest : public StoreConformance {
 protected:
  // One commit that records these names, of robot "r".
  void Commit(const std::vector<std::string>& names) {
    ASSERT_TRUE(Write([&](Transaction& transaction) {
                  for (const std::string& name : names) {
                    const absl::Status status = Record(transaction, "r", name);
                    if (!status.ok()) return status;
                  }
                  return absl::OkStatus();
                }).ok());
  }

  absl::StatusOr<EventBatch> After(int64_t revision, int most = kAll,
                                   const EventFilter& filter = {}) {
    return Read([&](Snapshot& snapshot) {
      return EventsAfter(snapshot, revision, filter, most, kManyBytes);
    });
  }

  static std::string NamesOf(const EventBatch& batch) {
    std::string names;
    for (const v1::WatchEvent& event : batch.events) names += event.agent_report().name();
    return names;
  }
};

// Would catch events in another order than that of their commits, or without their resource.
TEST_P(EventsTest, AreToldInTheOrderOfTheirCommits) {
  Commit({"a", "b"});
  Commit({"c"});
  const auto batch = After(0);
  ASSERT_TRUE(batch.ok()) << batch.status();
  EXPECT_EQ(NamesOf(*batch), "abc");
  EXPECT_EQ(batch->events[0].revision(), batch->events[1].revision());
  EXPECT_LT(batch->events[1].revision(), batch->events[2].revision());
  EXPECT_EQ(batch->revision, batch->events[2].revision());
  EXPECT_FALSE(batch->has_more);
}

// Would catch a batch that ends within a commit: its rest would never be told.
TEST_P(EventsTest, ABatchNeverEndsWithinACommit) {
  Commit({"a", "b", "c"});
  Commit({"d"});
  const auto first = After(0, 1);
  ASSERT_TRUE(first.ok());
  EXPECT_EQ(NamesOf(*first), "abc");
  EXPECT_TRUE(first->has_more);
  EXPECT_EQ(NamesOf(*After(first->revision, 1)), "d");
}

// Would catch an event of a change that was rolled back.
TEST_P(EventsTest, AFailedClosureLeavesNone) {
  Commit({"a"});
  ASSERT_FALSE(Write([](Transaction& transaction) {
                 (void)Record(transaction, "r", "lost");
                 return absl::AbortedError("no");
               }).ok());
  EXPECT_EQ(NamesOf(*After(0)), "a");
}

// Would catch a watcher of one robot, kind or resource that sees others, or is told them again and
// again.
TEST_P(EventsTest, AFilterLeavesOutOthersAndGoesPastThem) {
  Commit({"a"});
  EventFilter other_robot;
  other_robot.robot_id = "q";
  const auto none = After(0, kAll, other_robot);
  ASSERT_TRUE(none.ok());
  EXPECT_TRUE(none->events.empty());
  EXPECT_EQ(none->revision, After(0)->revision);
  EventFilter kind;
  kind.kinds = {v1::KIND_JOB};
  EXPECT_TRUE(After(0, kAll, kind)->events.empty());
  EventFilter name;
  name.name = "a";
  EXPECT_EQ(NamesOf(*After(0, kAll, name)), "a");
}

// Would catch a history that grows for ever, or one that hides a gap from a watcher that was away
// too long.
TEST_P(EventsTest, TheForgottenIsOutOfRange) {
  Commit({"a"});
  const int64_t first = After(0)->revision;
  const auto has_old = [&] {
    return Read([&](Snapshot& snapshot) {
      return HasEventsToForget(snapshot, EventHistory{}, clock_.Now());
    });
  };
  clock_.Advance(absl::Hours(23));
  EXPECT_FALSE(*has_old());
  clock_.Advance(absl::Hours(2));
  EXPECT_TRUE(*has_old());
  Commit({"b"});
  const auto forgotten = Write(
      [](Transaction& transaction) { return ForgetEvents(transaction, EventHistory{}, kAll); });
  ASSERT_TRUE(forgotten.ok()) << forgotten.status();
  EXPECT_EQ(*forgotten, 1);
  EXPECT_EQ(After(0).status().code(), absl::StatusCode::kOutOfRange);
  EXPECT_EQ(NamesOf(*After(first)), "b");
}

// Would catch a bound on the number that keeps one too many or cuts a commit.
TEST_P(EventsTest, TheHistoryHoldsAtMostItsNumber) {
  for (const char* name : {"a", "b", "c", "d"}) Commit({name});
  const auto has_more_than = [&](int64_t count) {
    return *Read([&](Snapshot& snapshot) {
      return HasEventsToForget(snapshot, {.age = absl::Hours(24), .count = count}, clock_.Now());
    });
  };
  EXPECT_TRUE(has_more_than(3));
  EXPECT_FALSE(has_more_than(4));
  ASSERT_TRUE(Write([](Transaction& transaction) {
                return ForgetEvents(transaction, {.age = absl::Hours(24), .count = 2}, kAll);
              }).ok());
  const auto all =
      Read([](Snapshot& snapshot) { return EventsAfter(snapshot, 2, {}, kAll, kManyBytes); });
  ASSERT_TRUE(all.ok()) << all.status();
  EXPECT_EQ(NamesOf(*all), "cd");
}

// Would catch a server restored from an older backup that lets a watcher wait for revisions that it
// will use again.
TEST_P(EventsTest, ARevisionOfTheFutureIsOutOfRange) {
  Commit({"a"});
  EXPECT_EQ(After(1'000).status().code(), absl::StatusCode::kOutOfRange);
}

// Would catch a robot that changes without an event.
TEST_P(EventsTest, RobotsRecordTheirChanges) {
  AddRobot(*store_, "ur10");
  const auto batch = After(0);
  ASSERT_TRUE(batch.ok());
  ASSERT_EQ(batch->events.size(), 1u);
  EXPECT_EQ(batch->events[0].robot().nominal_revision().name(), "robots/ur10/nominals/1");
}

RequestKey Key(const std::string& digest) {
  return {.principal = "anna", .method = "M", .request_id = Uuid(1), .digest = digest};
}

// Would catch a second effect, or an answer given to another request.
TEST_P(EventsTest, AnAnswerIsKeptForItsRequestOnly) {
  ASSERT_TRUE(Write([](Transaction& transaction) {
                return KeepReply(transaction, Key("d"), "answer");
              }).ok());
  const auto find = [&](const RequestKey& key) {
    return Read([&](Snapshot& snapshot) { return FindReply(snapshot, key); });
  };
  EXPECT_EQ(**find(Key("d")), "answer");
  EXPECT_EQ(FaultFields(find(Key("other")).status()), std::vector<std::string>{"request_id"});
  RequestKey other = Key("d");
  other.principal = "ben";
  EXPECT_FALSE(find(other)->has_value());
}

// Would catch answers that are kept for ever, or thrown away within their 7 days.
TEST_P(EventsTest, AnswersAreForgottenAfterSevenDays) {
  ASSERT_TRUE(Write([](Transaction& transaction) {
                return KeepReply(transaction, Key("d"), "answer");
              }).ok());
  const auto forget = [&] {
    return Write([](Transaction& transaction) { return ForgetReplies(transaction, 10); });
  };
  clock_.Advance(absl::Hours(7 * 24 - 1));
  const auto has_old = [&] {
    return *Read([&](Snapshot& snapshot) { return HasRepliesToForget(snapshot, clock_.Now()); });
  };
  EXPECT_EQ(*forget(), 0);
  EXPECT_FALSE(has_old());
  clock_.Advance(absl::Hours(2));
  EXPECT_TRUE(has_old());
  EXPECT_EQ(*forget(), 1);
}

INSTANTIATE_TEST_SUITE_P(Backends, EventsTest,
                         ::testing::Values(Backend::kSqliteMemory, Backend::kSqliteFile));

}  // namespace
}  // namespace truepose::store
