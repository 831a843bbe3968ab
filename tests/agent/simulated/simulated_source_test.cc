#include "client/agent/simulated/simulated_source.h"

#include <gtest/gtest.h>

#include <thread>

#include "convert/frames.h"
#include "tests/agent/sources/fake_sink.h"
#include "tests/core/testing/robots.h"

namespace truepose::agent {
namespace {

std::shared_ptr<const Cell> MakeCell(std::vector<CellEvent> events = {}) {
  const Robot robot = testing::Stanford();
  SimulateOptions options;
  options.position_noise_sd_m = options.rotation_noise_sd_rad = 0;
  return std::make_shared<Cell>(robot, ModifiedIncremental(robot, ModelExtent::kInternal), Pose{},
                                options, std::move(events));
}

SimulatedOptions Options() {
  SimulatedOptions options;
  options.robot = "robots/stanford";
  options.poll = std::chrono::milliseconds(1);
  const Eigen::VectorXd middle = testing::Stanford().MiddleOfLimits();
  for (const double offset : {0.1, 0.2, -0.1}) {
    options.targets.emplace_back(middle.begin(), middle.end());
    for (double& q : options.targets.back()) q += offset;
  }
  return options;
}

Eigen::VectorXd JointsOf(const v1::Reading& reading) {
  return Eigen::Map<const Eigen::VectorXd>(reading.joints_measured().data(),
                                           reading.joints_measured_size());
}

// Would catch readings on the way or while it swings, and a pose of other joints than those read.
TEST(SimulatedSource, OneReadingOfEachTargetWhereItStandsStill) {
  FakeSink sink;
  const Stop stop;
  const auto cell = MakeCell();
  const SimulatedOptions options = Options();
  ASSERT_TRUE(SimulatedSource(cell, options).Run(sink, stop).ok());
  const FakeSession session = sink.Sessions().at(0);
  EXPECT_TRUE(session.sealed);
  EXPECT_EQ(session.content.robot(), "robots/stanford");
  ASSERT_EQ(session.readings.size(), 3u);
  for (size_t i = 0; i < 3; ++i) {
    const v1::Reading& reading = session.readings[i];
    for (size_t j = 0; j < options.targets[i].size(); ++j) {
      EXPECT_EQ(reading.joints_commanded(static_cast<int>(j)), options.targets[i][j]);
      // It counts as still within 1e-4 for half a second.
      EXPECT_NEAR(reading.joints_measured(static_cast<int>(j)), options.targets[i][j], 1e-4);
    }
    const Pose truth = cell->X_MB() * cell->TruePose(JointsOf(reading), 0);
    EXPECT_TRUE(convert::VectorFrom(reading.position_m()).isApprox(truth.p, 1e-12));
  }
  EXPECT_LT(*TimeOf(session.readings[0]) + absl::Seconds(2), *TimeOf(session.readings[1]));
}

// The whole way: at rest, in the middle, there, swinging, at rest again.
TEST(SimulatedSource, MovesEvenlyAndSwingsOut) {
  const SimulatedOptions options = Options();
  const auto at = [&](double t_s) { return JointsOnTheWay({0}, {1}, t_s, options)[0]; };
  EXPECT_EQ(at(0), 0.0);
  EXPECT_NEAR(at(options.move_s / 2), 0.5, 1e-12);
  EXPECT_NEAR(at(options.move_s), 1.0 + options.swing, 1e-12);
  EXPECT_LT(at(options.move_s + 1.0 / 6), 1.0);  // half a period later on the other side
  EXPECT_NEAR(at(options.move_s + 2), 1.0, 1e-7);
}

// Would catch a bump that the instrument does not see, or sees too early.
TEST(SimulatedSource, EventsComeAtTheirTime) {
  CellEvent bump{.at_s = 5};
  bump.base_shift_m = Eigen::Vector3d(0, 0.0005, 0);
  const auto cell = MakeCell({bump});
  FakeSink sink;
  const Stop stop;
  ASSERT_TRUE(SimulatedSource(cell, Options()).Run(sink, stop).ok());
  const std::vector<v1::Reading> readings = sink.Sessions().at(0).readings;
  const auto moved = [&](const v1::Reading& reading) {
    const Pose unmoved = cell->X_MB() * cell->TruePose(JointsOf(reading), 0);
    return (convert::VectorFrom(reading.position_m()) - unmoved.p).norm();
  };
  EXPECT_NEAR(moved(readings[0]), 0, 1e-12);
  EXPECT_NEAR(moved(readings[2]), 0.0005, 1e-12);
}

// Would catch a restart that measures again what is there, or leaves targets out.
TEST(SimulatedSource, ARestartGoesOnBehindItsLastReading) {
  FakeSink sink;
  Stop first;
  int appended = 0;
  sink.RefuseAppend([&](const auto&) {
    if (++appended == 2) first.Request();
    return appended == 2 ? absl::UnavailableError("gone") : absl::OkStatus();
  });
  ASSERT_TRUE(SimulatedSource(MakeCell(), Options()).Run(sink, first).ok());
  EXPECT_EQ(sink.Sessions().at(0).readings.size(), 1u);
  sink.RefuseAppend({});
  const Stop second;
  ASSERT_TRUE(SimulatedSource(MakeCell(), Options()).Run(sink, second).ok());
  ASSERT_EQ(sink.Sessions().size(), 1u);
  EXPECT_EQ(sink.Sessions()[0].readings.size(), 3u);
  EXPECT_TRUE(sink.Sessions()[0].sealed);
}

// Would catch a request that is not answered with its own poses, or answered twice.
TEST(SimulatedSource, RequestsAreAnswered) {
  FakeSink sink;
  const Stop stop;
  SimulatedOptions options = Options();
  MeasuringTask task;
  task.request = "robots/stanford/recalibrationRequests/1";
  for (size_t i = 0; i < 2; ++i) {
    task.poses.emplace_back().mutable_joints()->Add(options.targets[i].begin(),
                                                    options.targets[i].end());
  }
  options.for_requests = true;
  SimulatedSource source(MakeCell(), options);
  std::thread thread([&] { EXPECT_TRUE(source.Run(sink, stop).ok()); });
  sink.SetTask(task);
  EXPECT_TRUE(sink.WaitFor(
      [](const auto& sessions) { return sessions.size() == 1 && sessions[0].sealed; }));
  task.request = "robots/stanford/recalibrationRequests/2";
  sink.SetTask(task);
  EXPECT_TRUE(sink.WaitFor(
      [](const auto& sessions) { return sessions.size() == 2 && sessions[1].sealed; }));
  stop.Request();
  thread.join();
  EXPECT_EQ(sink.Sessions()[0].readings.size(), 2u);
}

TEST(SimulatedSource, TargetsOfAnotherRobotAreRefused) {
  FakeSink sink;
  const Stop stop;
  SimulatedOptions options = Options();
  options.targets = {{0, 0}};
  EXPECT_EQ(SimulatedSource(MakeCell(), options).Run(sink, stop).code(),
            absl::StatusCode::kInvalidArgument);
}

}  // namespace
}  // namespace truepose::agent
