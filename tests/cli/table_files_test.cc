// `truepose table` and `truepose accuracy-map` with --local, as a person uses them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/cli/run.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr char kSpec[] = R"(
verification_points: 2000
box:
  min_x_mm: 500
  max_x_mm: 700
  min_y_mm: -200
  max_y_mm: 200
  min_z_mm: 200
  max_z_mm: 500
  cone_deg: 15
  reference_joints: [3.14, -1.2, 1.8, -2.17, -1.57, 0]
)";

constexpr char kMapSpec[] = R"(
box:
  min_x_mm: 500
  max_x_mm: 1500
  min_y_mm: -200
  max_y_mm: 200
  min_z_mm: 200
  max_z_mm: 500
  reference_joints: [3.14, -1.2, 1.8, -2.17, -1.57, 0]
)";

// A calibrated UR10 and the table of a small cell.
class TableFilesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    Must({"simulate", robot_, "--poses", "60", "--seed", "3", "--output", session_});
    Must({"calibrate", "--local", "--robot", robot_, "--session", session_, "--output",
          calibration_});
    folder_.Write("cell.yaml", kSpec);
    folder_.Write("map.yaml", kMapSpec);
  }

  static Ran Must(const std::vector<std::string>& line) {
    Ran ran = RunCli(line);
    EXPECT_EQ(ran.code, 0) << ran.err;
    return ran;
  }

  std::vector<std::string> Sources() const {
    return {"--local",
            "--robot",
            robot_,
            "--calibration",
            calibration_,
            "--spec",
            folder_.Path("cell.yaml")};
  }

  static std::vector<std::string> Joined(std::vector<std::string> a,
                                         const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  }

  Ran Build() const {
    return Must(Joined(Joined({"table", "build"}, Sources()), {"--output", table_}));
  }

  const TempFolder folder_;
  const std::string robot_ = Example("ur10.yaml");
  const std::string session_ = folder_.Path("session.csv");
  const std::string calibration_ = folder_.Path("calibration.json");
  const std::string table_ = folder_.Path("ur10.tpct");
};

// Would catch a page that shows another table than was built, or figures that are missing.
TEST_F(TableFilesTest, BuildsShowsAndVerifies) {
  const std::string built = Build().out;
  EXPECT_THAT(built, StartsWith(Must({"table", "show", table_}).out));
  for (const char* part : {"Compensation table of robots/ur10", "verified worst", "verified 95 %",
                           "q2 + q3 + q4", "does not matter", "near a singularity",
                           "Predicted accuracy of the compensated tool (95 %)"})
    EXPECT_THAT(built, HasSubstr(part));
  const auto header = OneObject(Must({"table", "show", table_, "--json"}).out);
  EXPECT_EQ(At(header, "robot"), "robots/ur10");
  EXPECT_EQ(At(header, "axes.3.weights.1"), "1");
  const Ran verified = Must({"table", "verify", table_, "--against", calibration_, "--robot",
                             robot_, "--points", "2000"});
  EXPECT_THAT(verified.out, HasSubstr("found worst"));
}

// Would catch an estimate that builds, or is of another table.
TEST_F(TableFilesTest, EstimatesBeforeBuilding) {
  const auto estimate =
      OneObject(Must(Joined(Joined({"table", "estimate"}, Sources()), {"--json"})).out);
  Build();
  const auto header = OneObject(Must({"table", "show", table_, "--json"}).out);
  EXPECT_EQ(At(estimate, "size_bytes"), At(header, "estimated.size_bytes"));
  const Ran coarse = Must(Joined(
      Joined({"table", "estimate"}, Sources()),
      {"--set", "position_tolerance_mm=0.2", "--set", "rotation_tolerance_deg=0.05", "--json"}));
  EXPECT_LT(std::stod(At(OneObject(coarse.out), "size_bytes")),
            std::stod(At(estimate, "size_bytes")) / 2);
}

// Would catch a damaged file, one of another robot or a spec that is wrong, taken without a word.
TEST_F(TableFilesTest, RefusesWhatIsWrong) {
  Build();
  std::string bytes = folder_.Read("ur10.tpct");
  bytes[bytes.size() / 2] ^= 1;
  const Ran damaged = RunCli({"table", "show", folder_.Write("damaged.tpct", bytes)});
  EXPECT_EQ(damaged.code, 3);
  EXPECT_THAT(damaged.err, HasSubstr("damaged"));
  const Ran foreign = RunCli({"table", "verify", table_, "--against", calibration_, "--robot",
                              Example("franka_panda.yaml")});
  EXPECT_EQ(foreign.code, 3);
  const Ran too_large = RunCli(Joined(Joined({"table", "build"}, Sources()),
                                      {"--output", table_, "--set", "largest_bytes=9000"}));
  EXPECT_EQ(too_large.code, 3);
  EXPECT_THAT(too_large.err, HasSubstr("loosen the tolerances"));
  EXPECT_EQ(RunCli({"table", "build", "--local", "--calibration", calibration_}).code, 2);
  // The table that was there stays.
  EXPECT_EQ(RunCli({"table", "show", table_}).code, 0);
}

// Would catch a refusal that says twice what was found, and one that doesn't say what is wrong.
TEST_F(TableFilesTest, AFileThatIsNoTableHasOneFault) {
  Build();
  const std::string bytes = folder_.Read("ur10.tpct");
  const std::string cut = folder_.Write("cut.tpct", bytes.substr(0, 700));
  const Ran truncated = RunCli({"table", "show", cut, "--json"});
  EXPECT_EQ(truncated.code, 3);
  const auto error = OneObject(truncated.out);
  EXPECT_EQ(At(error, "error.faults.0.field"), cut + ": truncated");
  EXPECT_EQ(At(error, "error.faults.0.found"), "700 bytes");
  EXPECT_THAT(RunCli({"table", "show", folder_.Write("e.tpct", "")}).err,
              HasSubstr("e.tpct: truncated: found 0 bytes, expected a table"));
  EXPECT_THAT(RunCli({"table", "show", folder_.Write("n.tpct", std::string(9000, 'x'))}).err,
              HasSubstr("n.tpct: not a table: magic: found other bytes, expected those of a "
                        "compensation table"));
  EXPECT_THAT(
      RunCli({"table", "show", folder_.Path("none.tpct")}).err,
      HasSubstr("none.tpct: not opened: found No such file or directory, expected a table"));
}

// Would catch faults in metres of what was written in millimetres, or a field that was not written.
TEST_F(TableFilesTest, FaultsAreInTheUnitsThatWereWritten) {
  const auto error_of = [&](const std::vector<std::string>& sets) {
    std::vector<std::string> line = Joined({"table", "estimate"}, Sources());
    for (const std::string& set : sets) line = Joined(line, {"--set", set});
    const Ran ran = RunCli(line);
    EXPECT_EQ(ran.code, 3) << ran.out;
    return ran.err;
  };
  EXPECT_THAT(error_of({"position_tolerance_mm=0"}),
              HasSubstr("--spec: position_tolerance_mm: found 0 mm, expected 1e-05 mm to 1000 mm, "
                        "or none"));
  EXPECT_THAT(error_of({"position_tolerance_m=0"}),
              HasSubstr("--spec: position_tolerance_m: found 0 m, expected 1e-08 m to 1 m"));
  EXPECT_THAT(error_of({"rotation_tolerance_deg=-1"}),
              HasSubstr("--spec: rotation_tolerance_deg: found -1 deg, expected 5.72958e-07 deg"));
  EXPECT_THAT(error_of({"box.max_x_mm=400"}),
              HasSubstr("--spec: box.max_x_mm: found 400 mm, expected more than 500 mm"));
  EXPECT_THAT(error_of({"box.cone_deg=200"}),
              HasSubstr("--spec: box.cone_deg: found 200 deg, expected 0 deg to 180 deg"));
  EXPECT_THAT(error_of({"box.max_z_mm="}), HasSubstr("--spec: box.max_z_mm: found nothing"));
}

// Would catch a verdict that limits the calibration (here: no control set) and that nobody hears of
// who makes a table or a map of it.
TEST_F(TableFilesTest, AVerdictThatLimitsIsRepeated) {
  const std::string warning = "verdict is apply within volume";
  EXPECT_THAT(Build().err, HasSubstr(warning));
  EXPECT_THAT(Must(Joined({"accuracy-map", "--points", "2x2x2"}, Sources())).err,
              HasSubstr(warning));
}

// Would catch a fault of a file that nobody named.
TEST_F(TableFilesTest, FaultsNameSpecOnlyWhereOneWasGiven) {
  const std::vector<std::string> line = {"table", "estimate",      "--local",   "--robot",
                                         robot_,  "--calibration", calibration_};
  EXPECT_THAT(RunCli(line).err, HasSubstr("--set: largest_bytes: found a table of "));
  EXPECT_THAT(RunCli(Joined(line, {"--set", "verification_points=3"})).err,
              HasSubstr("--set: verification_points: found 3"));
}

// Would catch an export that loses nodes or digits.
TEST_F(TableFilesTest, ExportsEveryNode) {
  Build();
  const auto header = OneObject(Must({"table", "show", table_, "--json"}).out);
  double nodes = 1;
  for (int k = 0; k < 6; ++k)
    nodes *= std::stod(At(header, "axes." + std::to_string(k) + ".nodes"));
  const std::string csv = Must({"table", "export", table_}).out;
  EXPECT_THAT(csv, StartsWith("q1_rad,q2_rad,q3_rad,q2+q3+q4_rad,q5_rad,q6_rad,tx_m"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), nodes + 1);
  const auto json = OneObject(Must({"table", "export", table_, "--json"}).out);
  EXPECT_EQ(At(json, "coordinates.3"), "q2+q3+q4_rad");
  const std::string first = csv.substr(csv.find('\n') + 1);
  EXPECT_EQ(std::stod(first), std::stod(At(json, "nodes.0.at.0")));
}

// Would catch a map without its picture's parts, or a CSV of another grid.
TEST_F(TableFilesTest, MapsTheAccuracy) {
  const Ran map = Must({"accuracy-map", "--local", "--robot", robot_, "--calibration", calibration_,
                        "--spec", folder_.Path("map.yaml"), "--points", "4x5x2", "--csv",
                        folder_.Path("map.csv"), "--svg", folder_.Path("map.svg")});
  EXPECT_THAT(map.out, HasSubstr("of 40 points reached"));
  const std::string csv = folder_.Read("map.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 41);
  const std::string svg = folder_.Read("map.svg");
  EXPECT_THAT(svg, StartsWith("<svg xmlns="));
  for (const char* part : {"z 0.200 m", "z 0.500 m", "95 %, mm", "x m", "y m",
                           "stroke=\"#bbbbbb\"" /* not reached */, "</svg>"})
    EXPECT_THAT(svg, HasSubstr(part));
}

// Would catch a cell that is half as large as meant, since an edge that is missing counts as 0, and
// ranges that are dropped without a word.
TEST_F(TableFilesTest, ABoxHasSixEdgesAndIsTheOnlyDomain) {
  std::string spec(kSpec);
  spec.replace(spec.find("  min_y_mm: -200\n"), 17, "");
  folder_.Write("cell.yaml", spec + "joint_ranges:\n  joints:\n    - {lower: -1, upper: 1}\n");
  const Ran ran = RunCli(Joined({"table", "estimate"}, Sources()));
  EXPECT_NE(ran.code, 0);
  EXPECT_THAT(ran.err, HasSubstr("box.min_y_mm"));
  EXPECT_THAT(ran.err, HasSubstr("joint_ranges"));
}

// Would catch what is read and written over: a measured session, a calibration, a spec.
TEST_F(TableFilesTest, NothingIsWrittenOverWhatIsRead) {
  const std::string cell = folder_.Path("cell.yaml");
  const auto text = [](const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  const std::string before = text(calibration_);
  for (const std::string& output : {calibration_, cell}) {
    const Ran ran = RunCli(Joined({"table", "build", "--output", output}, Sources()));
    EXPECT_NE(ran.code, 0);
    EXPECT_THAT(ran.err, HasSubstr("--output"));
  }
  const std::string session = text(session_);
  EXPECT_NE(RunCli({"calibrate", "--local", "--robot", robot_, "--session", session_, "--output",
                    session_})
                .code,
            0);
  EXPECT_EQ(text(session_), session);
  EXPECT_EQ(text(calibration_), before);
  EXPECT_EQ(text(cell), kSpec);
}

}  // namespace
}  // namespace truepose::cli
