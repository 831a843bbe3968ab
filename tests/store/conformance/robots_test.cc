// Robots and nominal revisions.
#include "server/store/robots.h"

#include "server/store/names.h"
#include "tests/store/conformance/conformance.h"

namespace truepose::store {
namespace {

auto Create(const std::string& id, const std::string& digest) {
  return [=](Transaction& transaction) {
    return CreateRobot(transaction, id, SampleNominal(digest), digest);
  };
}

auto Revise(const std::string& id, const std::string& digest) {
  return [=](Transaction& transaction) {
    return AddNominalRevision(transaction, RobotName(id), SampleNominal(digest), digest);
  };
}

// Catches parts of a robot that aren't stored, times that aren't the clock's, an etag that a client
// can't use.
TEST_P(StoreConformance, ARobotIsReadAsItWasCreated) {
  const auto created = Write(Create("ur10", "one"));
  ASSERT_TRUE(created.ok()) << created.status();
  EXPECT_EQ(created->name(), "robots/ur10");
  EXPECT_EQ(created->nominal_revision().name(), "robots/ur10/nominals/1");
  EXPECT_EQ(created->nominal_revision().nominal().serial(), "one");
  EXPECT_EQ(created->create_time().seconds(), absl::ToUnixSeconds(clock_.Now()));
  EXPECT_FALSE(created->etag().empty());
  const auto read = Read([](Snapshot& snapshot) { return GetRobot(snapshot, "robots/ur10"); });
  EXPECT_EQ(read->SerializeAsString(), created->SerializeAsString());
}

// Catches a retry that fails or changes the robot, and other content that is taken for a retry.
TEST_P(StoreConformance, ARepeatedCreateIsHarmless) {
  const auto first = Write(Create("ur10", "one"));
  clock_.Advance(absl::Hours(1));
  EXPECT_EQ(Write(Create("ur10", "one"))->SerializeAsString(), first->SerializeAsString());
  const auto other = Write(Create("ur10", "two"));
  EXPECT_EQ(other.status().code(), absl::StatusCode::kAlreadyExists);
  EXPECT_EQ(FaultFields(other.status()), std::vector<std::string>{"robot_id"});
  ASSERT_TRUE(Write(Revise("ur10", "two")).ok());
  EXPECT_TRUE(Write(Create("ur10", "one")).ok()) << "the content it was created with";
  EXPECT_TRUE(Write(Create("ur10", "two")).ok()) << "the content it has now";
}

// Catches revisions that are renumbered, overwritten or doubled, and a robot that doesn't show its
// latest.
TEST_P(StoreConformance, RevisionsAreNumberedAndImmutable) {
  ASSERT_TRUE(Write(Create("ur10", "one")).ok());
  const auto before = Read([](Snapshot& snapshot) { return GetRobot(snapshot, "robots/ur10"); });
  const auto second = Write(Revise("ur10", "two"));
  ASSERT_TRUE(second.ok()) << second.status();
  EXPECT_EQ(second->name(), "robots/ur10/nominals/2");
  EXPECT_EQ(Write(Revise("ur10", "two"))->name(), "robots/ur10/nominals/2")
      << "the same content again";
  EXPECT_EQ(Write(Revise("ur10", "one"))->name(), "robots/ur10/nominals/3")
      << "back to older content";
  const auto first = Read(
      [](Snapshot& snapshot) { return GetNominalRevision(snapshot, "robots/ur10/nominals/1"); });
  EXPECT_EQ(first->nominal().serial(), "one");
  const auto robot = Read([](Snapshot& snapshot) { return GetRobot(snapshot, "robots/ur10"); });
  EXPECT_EQ(robot->nominal_revision().name(), "robots/ur10/nominals/3");
  EXPECT_GT(robot->revision(), before->revision());
  EXPECT_NE(robot->etag(), before->etag());
}

// Catches names that are guessed at, and messages that don't say which field.
TEST_P(StoreConformance, UnknownAndMalformedRobots) {
  for (const char* name : {"robots/none", "robots/ur1"}) {
    const auto robot = Read([&](Snapshot& snapshot) { return GetRobot(snapshot, name); });
    EXPECT_EQ(robot.status().code(), absl::StatusCode::kNotFound) << name;
    EXPECT_EQ(FaultFields(robot.status()), std::vector<std::string>{"name"});
  }
  EXPECT_EQ(Read([](Snapshot& snapshot) { return GetRobot(snapshot, "ur10"); }).status().code(),
            absl::StatusCode::kInvalidArgument);
  for (const char* id : {"", "UR10", "-a", "a b", "a/b"}) {
    EXPECT_EQ(Write(Create(id, "x")).status().code(), absl::StatusCode::kInvalidArgument) << id;
  }
  EXPECT_EQ(Write(Revise("none", "x")).status().code(), absl::StatusCode::kNotFound);
  ASSERT_TRUE(Write(Create("ur10", "one")).ok());
  const auto missing = Read(
      [](Snapshot& snapshot) { return GetNominalRevision(snapshot, "robots/ur10/nominals/2"); });
  EXPECT_EQ(missing.status().code(), absl::StatusCode::kNotFound);
}

// Catches pages that skip or repeat robots when some are added between two pages.
TEST_P(StoreConformance, PagesOfRobotsAreStableUnderInserts) {
  for (const char* id : {"b", "d", "f", "h"}) ASSERT_TRUE(Write(Create(id, id)).ok());
  const auto list = [&](const PageRequest& request) {
    return Read([&](Snapshot& snapshot) { return ListRobots(snapshot, request); });
  };
  const auto first = list({.size = 2, .token = ""});
  ASSERT_EQ(first->items.size(), 2u);
  EXPECT_EQ(first->items[1].name(), "robots/d");
  EXPECT_EQ(first->items[1].nominal_revision().digest(), "d");
  for (const char* id : {"a", "e"}) ASSERT_TRUE(Write(Create(id, id)).ok());
  const auto second = list({.size = 2, .token = first->next_page_token});
  ASSERT_EQ(second->items.size(), 2u);
  EXPECT_EQ(second->items[0].name(), "robots/e");
  EXPECT_EQ(second->items[1].name(), "robots/f");
  const auto third = list({.size = 2, .token = second->next_page_token});
  ASSERT_EQ(third->items.size(), 1u);
  EXPECT_EQ(third->items[0].name(), "robots/h");
  EXPECT_EQ(third->next_page_token, "");
}

// Catches a token of one list that is taken by another, and faults that come one at a time.
TEST_P(StoreConformance, BadPagesAreRefusedWithAllFaults) {
  ASSERT_TRUE(Write(Create("ur10", "one")).ok());
  ASSERT_TRUE(Write(Revise("ur10", "two")).ok());
  const auto revisions = Read([](Snapshot& snapshot) {
    return ListNominalRevisions(snapshot, "robots/ur10", {.size = 1, .token = ""});
  });
  ASSERT_EQ(revisions->items[0].name(), "robots/ur10/nominals/2") << "newest first";
  const auto crossed = Read([&](Snapshot& snapshot) {
    return ListRobots(snapshot, {.size = -1, .token = revisions->next_page_token});
  });
  EXPECT_EQ(crossed.status().code(), absl::StatusCode::kInvalidArgument);
  EXPECT_EQ(FaultFields(crossed.status()), (std::vector<std::string>{"page_size", "page_token"}));
  for (const char* token : {"x", "cGFnZTE=", "\xff"}) {
    EXPECT_EQ(
        Read([&](Snapshot& snapshot) { return ListRobots(snapshot, {.size = 0, .token = token}); })
            .status()
            .code(),
        absl::StatusCode::kInvalidArgument);
  }
}

}  // namespace
}  // namespace truepose::store
