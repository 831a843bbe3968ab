// Options of a calibration: each reaches core, each bad one is a fault of its field.
#include "convert/options.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "convert/run.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "tests/convert/samples.h"

namespace truepose::convert {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::UnorderedElementsAre;

v1::Calibration MustRun(const v1::CalibrationInput& input) {
  auto calibration = RunCalibration(input);
  EXPECT_TRUE(calibration.ok()) << calibration.status();
  return calibration.ok() ? *std::move(calibration) : v1::Calibration();
}

std::vector<std::string> FieldsOf(const absl::Status& status) {
  std::vector<std::string> fields;
  for (const Fault& fault : FaultsOf(status)) fields.push_back(fault.field);
  return fields;
}

// All at once: somebody who mistypes five options is told of five.
TEST(Options, EveryUnknownNameIsAFault) {
  v1::CalibrationOptions options;
  options.set_model("dh");
  options.set_estimator("newton");
  options.set_select("backward");
  options.set_effects("gain,backlash,creep");
  options.set_loss("cauchy");
  options.set_prior("vague");
  options.set_pose_matching("tool_space");
  EXPECT_THAT(FieldsOf(ValidateOptions(options)),
              UnorderedElementsAre("options.model", "options.estimator", "options.select",
                                   "options.effects", "options.effects", "options.loss",
                                   "options.prior", "options.pose_matching"));
}

TEST(Options, PriorsAreChecked) {
  v1::CalibrationOptions options;
  options.set_prior("calibration");
  EXPECT_THAT(FieldsOf(ValidateOptions(options)), ElementsAre("options.prior_calibration"));
  v1::PriorCalibration* prior = options.mutable_prior_calibration();
  prior->add_identified("dq2");
  prior->add_identified("dq3");
  prior->add_covariance(1e-8);
  prior->set_model_sd_position_mm(0.1);
  EXPECT_THAT(FieldsOf(ValidateOptions(options)),
              ElementsAre("options.prior_calibration.covariance"));
  prior->clear_identified();
  prior->clear_covariance();
  prior->set_model_sd_position_mm(0);
  EXPECT_THAT(FieldsOf(ValidateOptions(options)),
              ElementsAre("options.prior_calibration.model_sd_position_mm"));
  options.set_prior("tolerance");
  EXPECT_THAT(FieldsOf(ValidateOptions(options)), Contains("options.prior"));
}

TEST(Options, NamesReachCore) {
  v1::CalibrationOptions message;
  message.set_model("zhuang_roth");
  message.set_estimator("kalman");
  message.set_select("bic");
  message.set_effects("gain,harmonic2,gain");
  message.set_loss("tukey");
  message.set_prior("tolerance");
  message.set_calibrate("joint_offsets");
  const auto options = CalibrateOptionsFrom(message);
  ASSERT_TRUE(options.ok()) << options.status();
  EXPECT_EQ(options->model, "zhuang_roth");
  EXPECT_EQ(options->identify.solve.estimator, Estimator::kKalman);
  EXPECT_EQ(options->select->criterion, SelectionCriterion::kBic);
  EXPECT_THAT(options->effect_groups, ElementsAre(EffectGroup::kGain, EffectGroup::kHarmonic2));
  EXPECT_EQ(options->identify.loss, Loss::kTukey);
  EXPECT_EQ(options->prior, PriorKind::kTolerance);
  EXPECT_EQ(options->calibrate, "joint_offsets");
}

// A report names what was done, and compensation understands every model with effects: the
// corrected joints put the identified robot where the nominal one would be.
TEST(Options, ModelsAndEffectsGoAllTheWay) {
  for (const char* model : {"modified_incremental", "incremental", "extended_dh", "zhuang_roth"}) {
    v1::CalibrationInput input = SampleInput(161);
    input.mutable_options()->set_model(model);
    input.mutable_options()->set_effects("gain,harmonic1");
    const v1::Calibration calibration = MustRun(input);
    EXPECT_EQ(calibration.report().model(), model);
    EXPECT_THAT(calibration.report().effects(), ElementsAre("gain", "harmonic1"));
    EXPECT_EQ(calibration.report().parameters().identified(), 48);
    v1::CompensateRequest request;
    v1::CompensationTarget* target = request.add_targets();
    for (double q : {0.3, -1.2, 1.4, -0.5, 1.1, 0.2}) target->add_joints(q);
    const auto response = RunCompensation(input.nominal(), calibration, request);
    ASSERT_TRUE(response.ok()) << response.status();
    EXPECT_EQ(response->targets(0).fault(), "");
    EXPECT_LT(response->targets(0).residual_position_mm(), 1e-6);
  }
}

// Would catch rows without a temperature that pass for rows at the session's mean unsaid, and a
// warning to those who did not ask for the effect.
TEST(Options, MissingTemperaturesAreSaid) {
  v1::CalibrationInput input = SampleInput(81);
  auto* rows = input.mutable_sessions(0)->mutable_readings();
  for (int i = 3; i < rows->size(); ++i) rows->Mutable(i)->set_temperature_c(20 + i % 7);
  const auto warning = HasSubstr("3 rows have no temperature");
  EXPECT_THAT(MustRun(input).report().warnings(), Not(Contains(warning)));
  input.mutable_options()->set_effects("temperature");
  EXPECT_THAT(MustRun(input).report().warnings(), Contains(warning));
}

// A calibration of another model or with an effect that this program does not know is refused.
TEST(Options, AStrangersCalibrationIsRefused) {
  v1::CalibrationInput input = SampleInput(61);
  v1::Calibration calibration = MustRun(input);
  calibration.mutable_report()->add_effects("creep");
  EXPECT_THAT(FieldsOf(RunCompensation(input.nominal(), calibration, {}).status()),
              ElementsAre("calibration.report.effects"));
  calibration.mutable_report()->clear_effects();
  calibration.mutable_report()->set_model("dh");
  EXPECT_THAT(FieldsOf(RunCompensation(input.nominal(), calibration, {}).status()),
              ElementsAre("calibration.report.model"));
}

// A calibration comes back as the prior of a partial one: held parameters keep their bits, and the
// report tests the change.
TEST(Options, PartOfAStoredCalibration) {
  v1::CalibrationInput input = SampleInput(121);
  const v1::Calibration stored = MustRun(input);
  input.mutable_options()->set_split("");
  auto* readings = input.mutable_sessions(0)->mutable_readings();
  while (readings->size() > 6) readings->RemoveLast();
  input.mutable_options()->set_calibrate("dq3");
  input.mutable_options()->set_prior("calibration");
  *input.mutable_options()->mutable_prior_calibration() = PriorOf(stored);
  EXPECT_EQ(input.options().prior_calibration().identified_size(), 18);
  EXPECT_EQ(input.options().prior_calibration().covariance_size(), 18 * 18);
  const v1::Calibration part = MustRun(input);
  EXPECT_THAT(part.report().change().names(), ElementsAre("dq3"));
  EXPECT_FALSE(part.report().change().real()) << "it is the same robot";
  EXPECT_EQ(part.report().verdict(), "do_not_apply");
  for (int i = 0; i < part.internal_parameters_size(); ++i) {
    if (part.internal_parameters(i).name() == "dq3") continue;
    EXPECT_EQ(part.internal_parameters(i).value(), stored.internal_parameters(i).value());
  }
  // Base and tool stand beside what the earlier calibration had, and not beside zero.
  for (const v1::ParameterValue& value : part.report().parameters().values()) {
    for (const v1::ParameterValue& earlier : stored.report().parameters().values()) {
      if (value.name() != earlier.name()) continue;
      EXPECT_NEAR(value.nominal(), earlier.identified(), 1e-9) << value.name();
    }
  }
  input.mutable_options()->set_calibrate("dq3,elbow");
  EXPECT_THAT(FieldsOf(RunCalibration(input).status()), ElementsAre("options.calibrate"));
}

// Commanded joints beside the measured ones, `sd` rad apart, in the rows of one role or in all.
enum class Rows { kAll, kEven };
void Command(double sd, Rows rows, v1::CalibrationInput* input) {
  Random random(3);
  for (v1::Reading& reading : *input->mutable_sessions(0)->mutable_readings()) {
    const bool exact = rows == Rows::kEven && reading.row() % 2 == 1;
    for (double q : reading.joints_measured())
      reading.add_joints_commanded(exact ? q : q + sd * random.Normal());
  }
}

// What was measured is worse than what was commanded: exchanged.
void Exchange(v1::CalibrationInput* input) {
  for (v1::Reading& reading : *input->mutable_sessions(0)->mutable_readings())
    reading.mutable_joints_measured()->Swap(reading.mutable_joints_commanded());
}

// Both joint sources: the better one is kept and named.
TEST(Options, BothJointSources) {
  v1::CalibrationInput input = SampleInput(81);
  Command(1e-3, Rows::kAll, &input);
  input.mutable_options()->set_joints("both");
  const v1::Calibration calibration = MustRun(input);
  EXPECT_THAT(calibration.report().joints_compared(), HasSubstr("measured joints fit better"));
  EXPECT_EQ(calibration.report().joints_used(), "measured");
  Exchange(&input);
  EXPECT_EQ(MustRun(input).report().joints_used(), "commanded");
}

// Unasked, the other source is compared and the result stays, bit for bit, what it was; the better
// one is named also when it is the one that was not used. Asked for one, nothing is compared.
TEST(Options, OtherJointsAreComparedUnasked) {
  v1::CalibrationInput input = SampleInput(81);
  const std::string digest = MustRun(input).digest();
  Command(1e-3, Rows::kAll, &input);
  const v1::Calibration calibration = MustRun(input);
  EXPECT_EQ(calibration.digest(), digest);
  EXPECT_THAT(calibration.report().joints_compared(),
              HasSubstr("measured joints fit better: RMS position of 41 calibration rows"));
  input.mutable_options()->set_joints("measured");
  EXPECT_EQ(MustRun(input).report().joints_compared(), "");
  EXPECT_EQ(MustRun(input).digest(), digest);
  Exchange(&input);
  input.mutable_options()->clear_joints();
  const v1::Calibration worse = MustRun(input);
  EXPECT_EQ(worse.report().joints_used(), "measured");
  EXPECT_THAT(worse.report().joints_compared(), HasSubstr("commanded joints fit better"));
}

// The number before a text.
double FigureBefore(const std::string& text, const std::string& what) {
  const size_t end = text.find(what), begin = text.rfind(' ', end - 1) + 1;
  return end == std::string::npos ? 0 : std::stod(text.substr(begin, end - begin));
}

// The quick comparison is what two whole runs give, but for their weights: it keeps those of the
// joints that are used, which moves the RMS with the others by one or two hundredths, where the two
// sources differ by a factor. Would catch a fit with the other joints that is no minimum.
TEST(Options, TheComparisonIsThatOfTwoRuns) {
  v1::CalibrationInput input = SampleInput(81);
  Command(1e-3, Rows::kAll, &input);
  const std::string quick = MustRun(input).report().joints_compared();
  for (const char* joints : {"measured", "commanded"}) {
    input.mutable_options()->set_joints(joints);
    const double rms = MustRun(input).report().sets().calibration().after().position_mm().rms();
    EXPECT_NEAR(FigureBefore(quick, std::string(" mm with ") + joints), rms, 0.03 * rms);
  }
}

// Would catch a choice by the control set: there both sources are the same, or the other one wins.
TEST(Options, TheControlSetDoesNotChoose) {
  v1::CalibrationInput input = SampleInput(81);
  Command(1e-3, Rows::kEven, &input);
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings()) {
    if (reading.row() % 2 == 1) (*reading.mutable_joints_measured())[0] += 2e-3;
  }
  for (const char* joints : {"", "both"}) {
    input.mutable_options()->set_joints(joints);
    EXPECT_THAT(MustRun(input).report().joints_compared(), HasSubstr("measured joints fit better"));
  }
}

// The chapter's E_op is the mean of the position errors, which the simplex minimises instead.
// Both from the same start; no worse than least squares in what it is the minimum of.
TEST(Options, MeanErrorAsObjective) {
  v1::CalibrationInput input = SampleInput(81);
  input.mutable_options()->set_estimator("simplex");
  input.mutable_options()->set_objective("least_squares");
  const v1::CalibrationReport least = MustRun(input).report();
  input.mutable_options()->clear_objective();
  EXPECT_EQ(MustRun(input).report().sets().calibration().after().position_mm().mean(),
            least.sets().calibration().after().position_mm().mean());
  input.mutable_options()->set_objective("e_op");
  const v1::CalibrationReport mean = MustRun(input).report();
  EXPECT_LT(mean.sets().calibration().after().position_mm().mean(),
            least.sets().calibration().after().position_mm().mean());
  for (const char* estimator : {"", "kalman", "linear_iteration"}) {
    input.mutable_options()->set_estimator(estimator);
    EXPECT_THAT(FieldsOf(RunCalibration(input).status()), ElementsAre("options.objective"));
  }
  input.mutable_options()->set_estimator("simplex");
  input.mutable_options()->set_objective("e_or");
  EXPECT_THAT(FieldsOf(ValidateOptions(input.options())), ElementsAre("options.objective"));
}

// Would catch an evaluation with measured joints of parameters that were found with commanded ones:
// a constant shift between the two is an error of that size.
TEST(Options, AnEvaluationTakesTheCalibrationsJoints) {
  v1::CalibrationInput input = SampleInput(81);
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings()) {
    *reading.mutable_joints_commanded() = reading.joints_measured();
    (*reading.mutable_joints_measured())[2] += 0.01;
  }
  input.mutable_options()->set_joints("commanded");
  const v1::Calibration calibration = MustRun(input);
  const auto evaluation =
      RunEvaluation(input.nominal(), calibration, input.sessions(0), v1::OBSERVE_UNSPECIFIED);
  ASSERT_TRUE(evaluation.ok()) << evaluation.status();
  EXPECT_LT(evaluation->set().after().position_mm().rms(), 0.2);
  EXPECT_THAT(evaluation->warnings(), ::testing::IsEmpty());
  for (v1::Reading& reading : *input.mutable_sessions(0)->mutable_readings())
    reading.clear_joints_commanded();
  const auto warned =
      RunEvaluation(input.nominal(), calibration, input.sessions(0), v1::OBSERVE_UNSPECIFIED);
  ASSERT_TRUE(warned.ok()) << warned.status();
  EXPECT_THAT(warned->warnings(), Contains(HasSubstr("commanded joints")));
}

// Readings of one group at the same joints: the mean distance of pairs and ISO's RP are those of
// the noise that was added.
TEST(Options, RepeatabilityOfGroups) {
  v1::CalibrationInput input = SampleInput(60);
  auto* readings = input.mutable_sessions(0)->mutable_readings();
  for (int i = 0; i < 20; ++i) {
    v1::Reading again = readings->Get(i);
    readings->Mutable(i)->set_group("place " + std::to_string(i));
    again.set_group("place " + std::to_string(i));
    again.set_row(60 + i);
    again.mutable_position_m()->set_x(again.position_m().x() + (i % 2 == 0 ? 1e-4 : -1e-4));
    *readings->Add() = again;
  }
  const v1::Repeatability repeat = MustRun(input).report().repeatability();
  EXPECT_EQ(repeat.pairs(), 20);
  EXPECT_EQ(repeat.groups(), 20);
  EXPECT_NEAR(repeat.difference_mean_mm(), 0.1, 1e-9);
  EXPECT_NEAR(repeat.chapter_mm(), 0.1, 1e-6);
  EXPECT_NEAR(repeat.iso_rp_mm(), 0.05, 1e-6);
}

// Eqs. 8 and 9: residuals in the joints. Exact places, noisy joints: both forms find the robot, and
// the joint form needs the joints' noise.
TEST(Options, PoseMatchingInJointSpace) {
  v1::CalibrationInput input = SampleInput(81);
  input.mutable_options()->set_pose_matching("joint_space");
  EXPECT_THAT(FieldsOf(RunCalibration(input).status()), ElementsAre("options.joint_sd"));
  input.mutable_options()->add_joint_sd(2e-4);
  const v1::Calibration joint = MustRun(input);
  input.mutable_options()->set_pose_matching("task_space");
  const v1::Calibration task = MustRun(input);
  EXPECT_GT(joint.report().summary().model_sd_position_mm(), 0) << "else it is no prior";
  EXPECT_EQ(joint.report().summary().termination(), "converged");
  EXPECT_NEAR(joint.report().sets().control().after().position_mm().rms(),
              task.report().sets().control().after().position_mm().rms(),
              0.2 * task.report().sets().control().after().position_mm().rms());
}

}  // namespace
}  // namespace truepose::convert
