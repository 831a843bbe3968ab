#include "client/cli/report.h"

#include <gtest/gtest.h>

#include <sstream>

#include "google/protobuf/text_format.h"

namespace truepose::cli {
namespace {

constexpr char kCalibration[] = R"pb(
  report {
    model: "modified_incremental"
    estimator: "levenberg_marquardt"
    split: "even-odd"
    joints_used: "measured"
    parameters {
      identified: 2
      values { name: "dq2" nominal: 0 identified: -0.0125 sd: 0.0011 unit: "deg" group: INTERNAL }
      values { name: "base_x" nominal: 100 identified: 100.5 sd: 0.02 unit: "mm" group: BASE }
    }
    sets {
      calibration {
        poses: 2
        before {
          position_mm { mean: 1 sd: 0.25 rms: 1.031 max: 1.5 }
          rotation_deg { mean: 0.07 sd: 0.01 rms: 0.071 max: 0.1 }
        }
        after {
          position_mm { mean: 0.4 sd: 0.2 rms: 0.447 max: 0.9 }
          rotation_deg { mean: 0.05 sd: 0.01 rms: 0.051 max: 0.09 }
        }
      }
      control {
        poses: 1
        before { position_mm { mean: 2 rms: 2 max: 2 } }
        after { position_mm { mean: 1 rms: 1 max: 1 } }
      }
    }
    redundancies {
      dropped: "dbeta2"
      relation: "dbeta2 = +1 dq2"
      reason: "parallel axes"
      structural: true
    }
    verdict: "do_not_apply"
    verdict_reasons: "the control set is too small"
    warnings: "joint 1: 2 rows"
    summary {
      termination: "converged"
      iterations: 7
      residuals: 12
      condition: 41.25
      model_sd_position_mm: 0.284
      model_sd_rotation_deg: 0.034
      weighted_residual_variance: 0.99
    }
    frames {
      name: ""
      group: BASE
      pose { x_m: 0.1005 qw: 1 }
      fitted_on: "calibration rows"
    }
  }
  residuals { row: 0 before_position_mm: 1 after_position_mm: 0.5 }
  residuals { row: 1 control: true before_position_mm: 2 after_position_mm: 1 }
)pb";

constexpr char kText[] =
    R"(Model modified_incremental, estimator levenberg_marquardt, measured joints, split even-odd
converged after 7 iterations; 2 parameters identified from 12 residuals, condition 41.2
unexplained per axis: 0.284 mm, 0.034 deg; weighted residual variance 0.99

Parameters
  name    group      nominal  identified   change      sd  unit
  dq2     internal    0.0000     -0.0125  -0.0125  0.0011  deg
  base_x  base      100.0000    100.5000   0.5000  0.0200  mm

Tool in the frame of the flange, base in that of the instrument
  frame  name     x mm   y mm   z mm        qx        qy        qz        qw  fitted on
  base         100.500  0.000  0.000  0.000000  0.000000  0.000000  1.000000  calibration rows

Parameters that stay at nominal
  parameter  acts as
  dbeta2     +1 dq2   at any poses

Residuals
  set          rows          mm: mean     sd    rms    max  deg: mean     sd    rms    max
  calibration     2  before     1.000  0.250  1.031  1.500      0.070  0.010  0.071  0.100
                     after      0.400  0.200  0.447  0.900      0.050  0.010  0.051  0.090
  control         1  before     2.000  0.000  2.000  2.000
                     after      1.000  0.000  1.000  1.000

Position residuals of the control rows in mm
  from mm  before                            after
      0.0       0                                0
      0.2       0                                0
      0.4       0                                0
      0.6       0                                0
      0.8       0                                0
      1.0       0                                1  ########################
      1.2       0                                0
      1.4       0                                0
      1.6       0                                0
      1.8       1  ########################      0

Warning: joint 1: 2 rows

Verdict: do not apply
  the control set is too small
)";

v1::Calibration Calibration() {
  v1::Calibration calibration;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(kCalibration, &calibration));
  return calibration;
}

std::string Text(bool colour) {
  std::ostringstream out, err;
  Console console{out, err};
  console.colour = colour;
  return CalibrationText(Calibration(), console);
}

// Golden text: would catch a wrong unit, a swapped before and after, a lost section, a wrong
// rounding.
TEST(CalibrationText, IsWhatAPersonReads) { EXPECT_EQ(Text(false), kText); }

// Would catch a deviation of rotations that nobody measured, such as the start value's.
TEST(CalibrationText, SpeaksOfNoRotationWhereNoneWasMeasured) {
  v1::Calibration calibration = Calibration();
  calibration.mutable_report()->mutable_summary()->clear_model_sd_rotation_deg();
  std::ostringstream out, err;
  const std::string text = CalibrationText(calibration, Console{out, err});
  EXPECT_NE(text.find("unexplained per axis: 0.284 mm; weighted"), std::string::npos) << text;
}

// Would catch sessions counted from another number than rows: the session stands by name.
TEST(CalibrationText, NamesASuspectsSessionAndCountsRowsFromZero) {
  v1::Calibration calibration = Calibration();
  calibration.add_sessions("monday.csv");
  calibration.add_sessions("sessions/11111111-2222-4333-8444-555555555555");
  for (int session : {0, 1}) {
    v1::Suspect* suspect = calibration.mutable_report()->add_suspects();
    suspect->set_session(session);
    suspect->set_row(7);
    suspect->set_reason("off");
  }
  std::ostringstream out, err;
  const std::string text = CalibrationText(calibration, Console{out, err});
  EXPECT_NE(text.find("(rows count from 0, as in --split)"), std::string::npos) << text;
  EXPECT_NE(text.find("  monday.csv                              7    0.00  off\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  11111111-2222-4333-8444-555555555555    7    0.00  off\n"),
            std::string::npos)
      << text;
}

// Would catch rotation figures of zero where none was measured, and a line for a set that is not
// there.
TEST(SetsTable, LeavesOutWhatWasNotMeasured) {
  const std::string text = SetsTable(Calibration().report().sets());
  EXPECT_NE(text.find("control         1  before     2.000  0.000  2.000  2.000\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("complete"), std::string::npos);
}

// Would catch a histogram over rows that had their part in the fit.
TEST(ResidualHistogram, ShowsTheControlRowsWhereThereAreSome) {
  v1::Calibration calibration = Calibration();
  EXPECT_EQ(
      ResidualHistogram(calibration, false).find("Position residuals of the control rows in mm\n"),
      0u);
  calibration.mutable_residuals()->DeleteSubrange(1, 1);
  EXPECT_EQ(ResidualHistogram(calibration, false).find("Position residuals of the rows in mm\n"),
            0u);
  calibration.clear_residuals();
  EXPECT_EQ(ResidualHistogram(calibration, false), "");
}

// Would catch colour codes in a file, or a red verdict shown green.
TEST(VerdictText, IsColouredOnATerminalOnly) {
  EXPECT_EQ(Text(false).find('\x1b'), std::string::npos);
  EXPECT_NE(Text(true).find("Verdict: \x1b[31mdo not apply\x1b[0m\n"), std::string::npos);
}

TEST(TimeText, IsUtc) {
  google::protobuf::Timestamp time;
  EXPECT_EQ(TimeText(time), "");
  time.set_seconds(1700000000);
  EXPECT_EQ(TimeText(time), "2023-11-14 22:13:20Z");
}

// Catches: a compliance of 2.1e-4 +- 3.4e-6 deg/(N m) printed as "0.0002 0.0000".
TEST(ParametersTable, ShowsTwoDigitsOfTheDeviation) {
  v1::ParameterReport parameters;
  v1::ParameterValue& value = *parameters.add_values();
  parameters.set_identified(1);
  value.set_name("compliance2");
  value.set_group(v1::INTERNAL);
  value.set_identified(2.1234e-4);
  value.set_sd(3.41e-6);
  value.set_unit("deg/(N m)");
  const std::string text = ParametersTable(parameters, false);
  EXPECT_NE(text.find("0.0002123"), std::string::npos) << text;
  EXPECT_NE(text.find("0.0000034"), std::string::npos) << text;
}

// Catches: an unexplained angle where no angle was measured.
TEST(CalibrationText, LeavesOutAnAngleThatWasNotMeasured) {
  v1::Calibration calibration = Calibration();
  calibration.mutable_report()
      ->mutable_sets()
      ->mutable_calibration()
      ->mutable_after()
      ->clear_rotation_deg();
  std::ostringstream out;
  const std::string text = CalibrationText(calibration, {out, out});
  EXPECT_NE(text.find("unexplained per axis: 0.284 mm; weighted"), std::string::npos) << text;
}

}  // namespace
}  // namespace truepose::cli
