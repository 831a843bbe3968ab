// A stored calibration in another model: would catch values without their covariance, a covariance
// carried through the wrong derivative, frames left behind, and a digest of the old values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "convert/calibrated_model.h"
#include "convert/digest.h"
#include "convert/frames.h"
#include "convert/report.h"
#include "convert/robot.h"
#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/identification/prediction.h"
#include "core/models/build_model.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::HasSubstr;

v1::Calibration Calibrated(const v1::CalibrationInput& input) {
  auto calibration = RunCalibration(input);
  EXPECT_TRUE(calibration.ok()) << calibration.status();
  return calibration.ok() ? *std::move(calibration) : v1::Calibration();
}

v1::Calibration Converted(const v1::CalibrationInput& input, const v1::Calibration& calibration,
                          const std::string& model) {
  auto converted = RunConversion(input.nominal(), calibration, model);
  EXPECT_TRUE(converted.ok()) << converted.status();
  return converted.ok() ? *std::move(converted) : v1::Calibration();
}

// A calibration message as something that predicts.
struct Predictor {
  Predictor(const Robot& robot, const v1::Calibration& calibration)
      : model(CalibratedModelFrom(robot, calibration).value()) {
    problem.model = &model.model;
    estimate.lambda = model.lambda;
    for (const v1::FrameEstimate& frame : calibration.report().frames()) {
      const bool base = frame.group() == v1::BASE;
      (base ? problem.placements : problem.targets).push_back(frame.name());
      (base ? estimate.X_MB : estimate.X_FT).push_back(PoseFrom(frame.pose()));
    }
    for (const v1::ParameterValue& value : calibration.report().parameters().values())
      columns.push_back(*Candidates(problem).Find(value.name()));
    const auto n = static_cast<Eigen::Index>(columns.size());
    covariance = Eigen::Map<const Eigen::MatrixXd>(calibration.covariance().data(), n, n);
  }

  Pose At(const Reading& reading) const { return Predict(problem, reading, estimate); }

  // Covariance of the predicted pose: position and rotation of the target in M.
  Eigen::MatrixXd CovarianceAt(Reading reading) const {
    reading.X_MT = At(reading);
    Workspace workspace;
    Residual r;
    ReadingJacobian J;
    EvaluateReading(*problem.model, reading, PointOf(reading, estimate), &workspace, &r, &J);
    Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(6, problem.CandidateCount());
    whole.middleCols<6>(problem.FirstOfBase(reading.placement)) = J.base;
    whole.middleCols<6>(problem.FirstOfTool(reading.target)) = J.tool;
    whole.rightCols(problem.model->parameters.size()) = J.internal;
    const Eigen::MatrixXd of_active = whole(Eigen::all, columns);
    return of_active * covariance * of_active.transpose();
  }

  CalibratedModel model;
  Problem problem;
  Estimate estimate;
  std::vector<int> columns;
  Eigen::MatrixXd covariance;
};

// Poses that the calibration has not seen, at every placement.
std::vector<Reading> Elsewhere(const Predictor& predictor, int joints) {
  Random random(71);
  std::vector<Reading> readings;
  for (int i = 0; i < 40; ++i) {
    Reading reading;
    reading.kind = ObservationKind::kPose;
    reading.q.resize(joints);
    for (double& q : reading.q) q = random.Uniform(-2.5, 2.5);
    reading.placement = i % predictor.problem.placement_count();
    reading.target = i % predictor.problem.target_count();
    readings.push_back(reading);
  }
  return readings;
}

// @param rows of the predicted pose that the calibration determines: 3 positions, or all 6.
void ExpectSamePrediction(const v1::CalibrationInput& input, const v1::Calibration& a,
                          const v1::Calibration& b, int rows) {
  const Robot robot = RobotFrom(input.nominal()).value();
  const Predictor from(robot, a), to(robot, b);
  for (const Reading& reading : Elsewhere(from, robot.joint_count())) {
    EXPECT_LT((from.At(reading).p - to.At(reading).p).norm(), 1e-9);
    if (rows == 6) {
      EXPECT_LT((from.At(reading).R - to.At(reading).R).norm(), 2e-9);
    }
    // To 1e-6 of its size; the derivative of the conversion is exact to rounding, frames and
    // parameters are converted to 1e-9 of a metre.
    const Eigen::MatrixXd before = from.CovarianceAt(reading).topLeftCorner(rows, rows),
                          after = to.CovarianceAt(reading).topLeftCorner(rows, rows);
    EXPECT_LT((after - before).norm(), 1e-6 * before.norm());
    const Eigen::Matrix3d position = before.topLeftCorner(3, 3);
    EXPECT_LT((after.topLeftCorner(3, 3) - position).norm(), 1e-6 * position.norm());
  }
}

class EveryModel : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryModel, PredictionAndItsCovarianceStay) {
  v1::CalibrationInput input = SampleInput(81);
  input.mutable_options()->set_effects("gain,harmonic1");
  input.mutable_options()->set_model(GetParam());
  const v1::Calibration calibration = Calibrated(input);
  for (const std::string& model : ModelKinds()) {
    SCOPED_TRACE(model);
    const v1::Calibration converted = Converted(input, calibration, model);
    EXPECT_EQ(converted.report().model(), model);
    EXPECT_EQ(converted.options().model(), model);
    EXPECT_EQ(converted.report().parameters().identified(),
              calibration.report().parameters().identified())
        << "both are minimal";
    ExpectSamePrediction(input, calibration, converted, 6);
    EXPECT_EQ(converted.digest(), CalibrationDigest(converted.report().convention(),
                                                    NominalDigest(input.nominal()), converted));
  }
}

INSTANTIATE_TEST_SUITE_P(ConvertModel, EveryModel, ::testing::ValuesIn(ModelKinds()));

// The converted deviations are those that a calibration in that model finds itself: the readings
// are the same, and so is the minimum. 1 %: weights are estimated anew there.
TEST(ConvertModel, DeviationsAreThoseOfACalibrationThere) {
  v1::CalibrationInput input = SampleInput(121);
  const v1::Calibration converted = Converted(input, Calibrated(input), "extended_dh");
  input.mutable_options()->set_model("extended_dh");
  const v1::ParameterReport there = Calibrated(input).report().parameters(),
                            here = converted.report().parameters();
  ASSERT_EQ(here.values_size(), there.values_size());
  for (int i = 0; i < here.values_size(); ++i) {
    EXPECT_EQ(here.values(i).name(), there.values(i).name());
    EXPECT_NEAR(here.values(i).sd(), there.values(i).sd(), 0.01 * there.values(i).sd());
    EXPECT_NEAR(here.values(i).identified(), there.values(i).identified(),
                0.05 * there.values(i).sd());
  }
}

// Points leave the target's rotation open, and it stays so; two placements keep their labels.
TEST(ConvertModel, PointsAtTwoPlacements) {
  v1::CalibrationInput input = SampleInput(101, "");
  input.mutable_options()->set_observe(v1::POINT);
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings())
    reading.set_placement(reading.row() < 50 ? "left" : "right");
  const v1::Calibration calibration = Calibrated(input);
  const v1::Calibration converted = Converted(input, calibration, "zhuang_roth");
  for (const v1::ParameterValue& value : converted.report().parameters().values())
    EXPECT_THAT(value.name(), ::testing::Not(HasSubstr("tool.r")));
  ExpectSamePrediction(input, calibration, converted, 3);
}

// A partial recalibration carries the covariance of what it held: none of it may be lost where the
// other model spreads what was found over more names (to second order dq3 moves all the others).
TEST(ConvertModel, HeldDirectionsKeepTheirCovariance) {
  v1::CalibrationInput input = SampleInput(81);
  *input.mutable_options()->mutable_prior_calibration() = PriorOf(Calibrated(input));
  input.mutable_options()->set_prior("calibration");
  input.mutable_options()->set_calibrate("dq3");
  const v1::Calibration calibration = Calibrated(input);
  ASSERT_EQ(calibration.report().parameters().identified(), 13);
  const v1::Calibration converted = Converted(input, calibration, "incremental");
  ExpectSamePrediction(input, calibration, converted, 6);
  EXPECT_GT(converted.report().parameters().identified(), 13);
  EXPECT_THAT(converted.report().warnings(),
              ::testing::Not(::testing::Contains(HasSubstr("has rank"))));
}

TEST(ConvertModel, RefusesWhatItCanNot) {
  const v1::CalibrationInput input = SampleInput(61);
  v1::Calibration calibration = Calibrated(input);
  const auto unknown = RunConversion(input.nominal(), calibration, "dh");
  ASSERT_EQ(FaultsOf(unknown.status()).size(), 1u);
  EXPECT_EQ(FaultsOf(unknown.status())[0].field, "options.model");
  calibration.mutable_covariance()->RemoveLast();
  const auto odd = RunConversion(input.nominal(), calibration, "incremental");
  ASSERT_EQ(FaultsOf(odd.status()).size(), 1u);
  EXPECT_EQ(FaultsOf(odd.status())[0].field, "calibration.covariance");
}

}  // namespace
}  // namespace truepose::convert
