// URDF as a robot file, and robots out as files of other programs, here and from a server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "server/calibration_runner.h"
#include "server/server.h"
#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kUuid[] = "11111111-2222-4333-8444-777777777777";

// A UR10 with errors of half a millimetre, and its truth as a calibration.
class ExportTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const Ran ran = RunCli({"simulate", robot_, "--poses", "60", "--seed", "3", "--output",
                            session_, "--truth", truth_});
    ASSERT_EQ(ran.code, 0) << ran.err;
  }

  Ran ExportTruth(const std::string& format, std::vector<std::string> more = {}) const {
    std::vector<std::string> line = {"calibration", "export", truth_,     "--local",
                                     "--robot",     robot_,   "--format", format};
    line.insert(line.end(), more.begin(), more.end());
    return RunCli(line);
  }

  std::string Urdf() const {
    const std::string path = folder_.Path("nominal.urdf");
    const Ran ran = RunCli({"robot", "export", robot_, "--local", "--format", "urdf", "-o", path});
    EXPECT_EQ(ran.code, 0) << ran.err;
    return path;
  }

  const TempFolder folder_;
  const std::string robot_ = Example("ur10.yaml");
  const std::string session_ = folder_.Path("session.csv"), truth_ = folder_.Path("truth.json");
};

// Would catch a format that is not reachable, or a file that differs from what is printed.
TEST_F(ExportTest, EachFormatIsPrintedOrWritten) {
  const std::vector<std::pair<std::string, std::string>> beginnings = {
      {"urdf", "<?xml version=\"1.0\"?>\n<robot name=\"ur10\">"},
      {"dh",
       "link,joint,type,theta_rad,d_m,a_m,alpha_rad\n0,base,constant,0,0,0,0\n1,shoulder_pan,"},
      {"robot", "robot: ur10\n"},
      {"ur_calibration", "kinematics:\n  shoulder:\n    x: "}};
  for (const auto& [format, beginning] : beginnings) {
    const Ran printed = ExportTruth(format);
    EXPECT_EQ(printed.code, 0) << printed.err;
    EXPECT_THAT(printed.out, StartsWith(beginning));
    const std::string path = folder_.Path(format);
    const Ran written = ExportTruth(format, {"-o", path});
    EXPECT_EQ(written.out, absl::StrCat(format, " of ur10 in ", path, "\n"));
    EXPECT_EQ(TextOf(path), printed.out);
  }
}

// Would catch warnings among the numbers of a table.
TEST_F(ExportTest, WarningsGoToStandardError) {
  const Ran ran = ExportTruth("dh");
  EXPECT_THAT(ran.err, HasSubstr("the axes of shoulder_lift and elbow are nearly parallel"));
  EXPECT_EQ(ran.out.find("parallel"), std::string::npos);
}

TEST_F(ExportTest, JsonIsTheMessage) {
  EXPECT_EQ(At(OneObject(ExportTruth("urdf", {"--json"}).out), "joints.2.name"), "elbow");
  EXPECT_EQ(At(OneObject(ExportTruth("dh", {"--json"}).out), "rows"), "[8]");
}

// Would catch a refusal that leaves a file, or comes with the wrong exit code.
TEST_F(ExportTest, FaultsLeaveNothing) {
  const std::string path = folder_.Path("out");
  const int before = folder_.FileCount();
  const Ran format = ExportTruth("collada", {"-o", path});
  EXPECT_EQ(format.code, 3);
  EXPECT_THAT(format.err, HasSubstr("--format: found 'collada', expected urdf, dh, robot or"));
  const Ran panda = RunCli({"robot", "export", Example("franka_panda.yaml"), "--local", "--format",
                            "ur_calibration", "-o", path});
  EXPECT_EQ(panda.code, 3);
  EXPECT_THAT(panda.err, HasSubstr("not built as those of Universal Robots"));
  const Ran other = RunCli({"calibration", "export", truth_, "--local", "--robot",
                            Example("stanford.yaml"), "--format", "urdf", "-o", path});
  EXPECT_EQ(other.code, 3);
  EXPECT_THAT(other.err, HasSubstr("--robot: found"));
  EXPECT_EQ(RunCli({"calibration", "export", truth_, "--local", "--format", "urdf"}).code, 2);
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"robot", "export", "ur10", "--format", "urdf"},
        {"calibration", "export", "ur10#1", "--format", "urdf"},
        {"evaluate", "--calibration", "ur10#1", "--session", kUuid},
        {"compensate", "t.csv", "--calibration", "ur10#1"}}) {
    std::vector<std::string> with_tip = command;
    with_tip.insert(with_tip.end(), {"--urdf-tip", "flange"});
    EXPECT_EQ(RunCli(with_tip).code, 2) << command[0];
  }
  EXPECT_EQ(folder_.FileCount(), before);
}

// A UR10 from URDF is the UR10: would catch a robot file that only some commands can read, and a
// geometry that is another one. The same errors fit in both.
TEST_F(ExportTest, UrdfServesAsRobotFile) {
  const std::string urdf = Urdf(), session = folder_.Path("urdf.csv");
  const Ran simulated =
      RunCli({"simulate", urdf, "--poses", "60", "--seed", "9", "--output", session});
  ASSERT_EQ(simulated.code, 0) << simulated.err;
  std::vector<double> rms;
  for (const std::string& robot : {robot_, urdf}) {
    const Ran ran = RunCli({"calibrate", "--local", "--robot", robot, "--session", session,
                            "--split", "even-odd", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto report = OneObject(ran.out);
    EXPECT_EQ(At(report, "parameters.identified"), "30");
    rms.push_back(std::stod(At(report, "sets.control.after.position_mm.rms")));
  }
  // Models of the same size about the same axes differ in the second order of the errors only.
  EXPECT_NEAR(rms[0], rms[1], 0.01 * rms[0]);
}

// A calibration's robot, read back as nominal, begins where the calibration ended: would catch an
// export that is a little off, or off by the wrong parameters, all the way through the files.
TEST_F(ExportTest, AnExportedCalibrationIsTheNominalOfTheNext) {
  const std::string file = folder_.Path("calibration.json");
  const std::vector<std::string> line = {"--session", session_, "--split", "even-odd", "--json"};
  const auto calibrate = [&](const std::string& robot, const std::string& output) {
    std::vector<std::string> whole = {"calibrate", "--local", "--robot", robot, "--output", output};
    whole.insert(whole.end(), line.begin(), line.end());
    const Ran ran = RunCli(whole);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return OneObject(ran.out);
  };
  const double after = std::stod(At(calibrate(robot_, file), "sets.control.after.position_mm.rms"));
  for (const char* format : {"urdf", "robot"}) {
    const std::string exported = folder_.Path(format);
    ASSERT_EQ(RunCli({"calibration", "export", file, "--local", "--robot", robot_, "--format",
                      format, "-o", exported})
                  .code,
              0);
    const auto report = calibrate(exported, folder_.Path("next.json"));
    // Base and tool are fitted with the weights of another run, which differ in some digits.
    EXPECT_NEAR(std::stod(At(report, "sets.control.before.position_mm.rms")), after, 1e-3 * after);
  }
}

// Would catch a URDF file whose kinematics nobody looks at.
TEST_F(ExportTest, ParallelSlidesAreRefusedWithTheirFile) {
  std::string text = "<robot name=\"r\"><link name=\"a\"/><link name=\"b\"/><link name=\"c\"/>";
  for (const auto& [joint, parent, child] :
       {std::array{"i", "a", "b"}, std::array{"j", "b", "c"}}) {
    absl::StrAppend(&text, "<joint name=\"", joint, "\" type=\"prismatic\"><parent link=\"", parent,
                    "\"/><child link=\"", child,
                    "\"/><axis xyz=\"0 0.6 0.8\"/><limit lower=\"0\" upper=\"1\" effort=\"1\" "
                    "velocity=\"1\"/></joint>");
  }
  const std::string path = folder_.Write("slides.urdf", text + "</robot>");
  const Ran ran = RunCli({"robot", "export", path, "--local", "--format", "robot"});
  EXPECT_EQ(ran.code, 3);
  EXPECT_THAT(ran.err, HasSubstr("slides.urdf: joints[1]: found prismatic joint j parallel to"));
}

// Would catch a tip that commands can't be told.
TEST_F(ExportTest, ATipIsAskedForAndTaken) {
  const std::string forked = folder_.Write(
      "forked.urdf",
      absl::StrReplaceAll(TextOf(Urdf()),
                          {{"</robot>",
                            "<link name=\"camera\"/><joint name=\"mast\" type=\"fixed\"><parent "
                            "link=\"base\"/><child link=\"camera\"/></joint></robot>"}}));
  const std::vector<std::string> line = {"robot", "export", forked, "--local", "--format", "robot"};
  const Ran asked = RunCli(line);
  EXPECT_EQ(asked.code, 3);
  EXPECT_THAT(asked.err, HasSubstr("--urdf-tip LINK, such as camera or flange"));
  std::vector<std::string> named = line;
  named.insert(named.end(), {"--urdf-tip", "flange"});
  const Ran taken = RunCli(named);
  EXPECT_EQ(taken.code, 0) << taken.err;
  EXPECT_THAT(taken.out, HasSubstr("standard_dh"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"simulate", forked, "--poses", "3"},
        {"evaluate", "--local", "--robot", forked, "--calibration", truth_, "--session", session_},
        {"compensate", Example("ur10_targets.csv"), "--local", "--robot", forked, "--calibration",
         truth_}}) {
    EXPECT_THAT(RunCli(command).err, HasSubstr("--urdf-tip LINK"));
    std::vector<std::string> with_tip = command;
    with_tip.insert(with_tip.end(), {"--urdf-tip", "flange"});
    EXPECT_THAT(RunCli(with_tip).err, ::testing::Not(HasSubstr("--urdf-tip LINK")));
  }
  const Ran yaml =
      RunCli({"robot", "export", robot_, "--local", "--format", "robot", "--urdf-tip", "flange"});
  EXPECT_EQ(yaml.code, 3);
}

// Would catch an export that depends on where the calibration is.
TEST_F(ExportTest, AServersCalibrationGivesTheSameFiles) {
  server::ServerOptions options;
  options.dev_open = true;
  options.listen = absl::StrCat("unix:", folder_.Path("socket"));
  options.database = ":memory:";
  const auto server = server::Server::Start(options, server::CalibrationRunner());
  ASSERT_TRUE(server.ok()) << server.status();
  const auto remote = [&](std::vector<std::string> line) {
    line.insert(line.end(), {"--server", (*server)->address()});
    const Ran ran = RunCli(line);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran.out;
  };
  const std::string urdf = Urdf(), file = folder_.Path("ur10-1.json");
  EXPECT_THAT(remote({"robot", "add", urdf}), StartsWith("Robot ur10: 6 joints"));
  EXPECT_EQ(remote({"robot", "export", "ur10", "--format", "urdf"}),
            RunCli({"robot", "export", urdf, "--local", "--format", "urdf"}).out);
  remote({"session", "import", session_, "--robot", "ur10", "--session-id", kUuid});
  remote({"calibrate", "--robot", "ur10", "--session", kUuid, "--split", "even-odd"});
  remote({"calibration", "show", "ur10#1", "--output", file});
  for (const char* format : {"urdf", "dh", "robot", "ur_calibration"}) {
    const Ran local =
        RunCli({"calibration", "export", file, "--local", "--robot", urdf, "--format", format});
    EXPECT_EQ(local.code, 0) << local.err;
    EXPECT_EQ(remote({"calibration", "export", "ur10#1", "--format", format}), local.out);
  }
}

}  // namespace
}  // namespace truepose::cli
