#include "server/rpc/executor.h"

#include <atomic>
#include <memory>

#include "absl/synchronization/notification.h"
#include "gtest/gtest.h"

namespace truepose::rpc {
namespace {

// Would catch a task that is lost when the executor ends: its call would never be finished.
TEST(ExecutorTest, RunsAllItAcceptedBeforeItEnds) {
  std::atomic<int> ran{0};
  int accepted = 0;
  {
    Executor executor(2, 1000);
    for (int i = 0; i < 200; ++i) accepted += executor.Submit([&] { ++ran; }) ? 1 : 0;
  }
  EXPECT_EQ(accepted, 200);
  EXPECT_EQ(ran, 200);
}

// Would catch a queue without bound, or one that loses the thread after a refusal.
TEST(ExecutorTest, RefusesWhatItHasNoRoomFor) {
  Executor executor(1, 2);
  absl::Notification started, go;
  ASSERT_TRUE(executor.Submit([&] {
    started.Notify();
    go.WaitForNotification();
  }));
  started.WaitForNotification();
  absl::Notification second, third;
  EXPECT_TRUE(executor.Submit([&] { second.Notify(); }));
  EXPECT_TRUE(executor.Submit([&] { third.Notify(); }));
  EXPECT_FALSE(executor.Submit([] {}));
  go.Notify();
  EXPECT_TRUE(second.WaitForNotificationWithTimeout(absl::Seconds(20)));
  EXPECT_TRUE(third.WaitForNotificationWithTimeout(absl::Seconds(20)));
}

// Would catch one slow call that holds up all others.
TEST(ExecutorTest, ThreadsRunBesideEachOther) {
  Executor executor(2, 10);
  absl::Notification met;
  ASSERT_TRUE(
      executor.Submit([&] { EXPECT_TRUE(met.WaitForNotificationWithTimeout(absl::Seconds(20))); }));
  ASSERT_TRUE(executor.Submit([&] { met.Notify(); }));
}

// Would catch a task whose captures die with the lock held: this destructor submits again.
TEST(ExecutorTest, WhatATaskHoldsDiesOutsideOfTheLock) {
  Executor executor(1, 10);
  absl::Notification ran;
  auto held = std::shared_ptr<int>(new int, [&](int* value) {
    delete value;
    EXPECT_TRUE(executor.Submit([&] { ran.Notify(); }));
  });
  ASSERT_TRUE(executor.Submit([held] {}));
  held.reset();
  EXPECT_TRUE(ran.WaitForNotificationWithTimeout(absl::Seconds(20)));
}

}  // namespace
}  // namespace truepose::rpc
