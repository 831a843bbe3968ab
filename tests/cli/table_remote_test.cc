// truepose table against a server in this process, whose builder is the test's own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "server/store/checksum.h"
#include "tests/cli/remote_fixture.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class TableRemoteTest : public RemoteFixture {
 protected:
  // The robot with an active calibration, on a server that builds small tables.
  void SetUp() override {
    runners_ = jobs::Runners(server::CalibrationRunner(), BuildTable, EstimateTable);
    RemoteFixture::SetUp();
    AddRobot();
    Import();
    Calibrate();
  }
  void Release() {
    Demand({"calibration", "approve", "ur10#1", "--reason", "looked at"});
    Demand({"calibration", "activate", "ur10#1"});
  }

  static std::string Bytes(const v1::CompensationTableInput& input) {
    return absl::StrCat("table of ", input.calibration().digest(), " with seed ",
                        input.spec().seed());
  }
  static absl::StatusOr<jobs::BuiltTable> BuildTable(const v1::CompensationTableInput& input,
                                                     const jobs::RunnerHooks&) {
    if (input.spec().seed() == 13) return FaultStatus("largest_bytes", "1 MB", "a smaller table");
    jobs::BuiltTable built{Bytes(input), {}};
    built.header.set_calibration(input.calibration().name());
    built.header.set_verification_points(10'000);
    built.header.mutable_verified()->set_worst_position_m(1.25e-5);
    return built;
  }
  static absl::StatusOr<v1::CompensationTableEstimate> EstimateTable(
      const v1::CompensationTableInput&) {
    v1::CompensationTableEstimate estimate;
    estimate.add_nodes(17);
    estimate.add_nodes(9);
    estimate.set_size_bytes(3 << 20);
    return estimate;
  }

  std::string Spec(const std::string& text) {
    std::ofstream(folder_.Path("spec.yaml")) << text;
    return folder_.Path("spec.yaml");
  }
  // The file that --output named.
  std::string Written() const {
    std::ifstream file(folder_.Path("t.tpct"), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
};

// Would catch a step that doesn't name the next, and bytes that are not the server's.
TEST_F(TableRemoteTest, BuildListShowDownload) {
  EXPECT_THAT(Demand({"table", "list"}).out, HasSubstr("Next: truepose table build"));
  Release();
  const Ran built = Demand({"table", "build", "--robot", "ur10"});
  EXPECT_THAT(built.out, HasSubstr("of ur10#1: ready"));
  EXPECT_THAT(built.out, HasSubstr("worst 0.0125 mm"));
  EXPECT_THAT(built.out, HasSubstr("Next: truepose table download ur10/"));
  EXPECT_THAT(Demand({"table", "list", "--robot", "ur10"}).out, HasSubstr("ur10#1"));
  EXPECT_THAT(Demand({"job", "list"}).out, HasSubstr("table"));
  const Ran fetched = Demand({"table", "download", "ur10", "--output", folder_.Path("t.tpct")});
  EXPECT_THAT(fetched.out, HasSubstr(store::Sha256Hex(Written())));
  EXPECT_THAT(Written(), HasSubstr("with seed 0"));
  EXPECT_THAT(Demand({"table", "show", "ur10"}).out, HasSubstr(store::Sha256Hex(Written())));
}

// Would catch an estimate that builds.
TEST_F(TableRemoteTest, EstimateBuildsNothing) {
  Release();
  const Ran estimated = Demand({"table", "estimate", "--calibration", "ur10#1"});
  EXPECT_THAT(estimated.out, HasSubstr("17 x 9 nodes, 3.00 MB"));
  EXPECT_THAT(Demand({"table", "list"}).out, HasSubstr("No tables"));
}

// Would catch a draft that is taken for a release, and faults in the words of the message.
TEST_F(TableRemoteTest, RefusalsAreInTheWordsOfTheCommandLine) {
  const Ran draft = Remote({"table", "build", "--calibration", "ur10#1"});
  EXPECT_EQ(draft.code, 1);
  EXPECT_THAT(draft.err, HasSubstr("--calibration: found robots/ur10/calibrations/1, which is a "
                                   "DRAFT, expected an approved one, or --allow-draft"));
  Demand({"table", "build", "--calibration", "ur10#1", "--allow-draft"});
  const Ran faulty = Remote({"table", "build", "--calibration", "ur10#1", "--allow-draft", "--spec",
                             Spec("verification_points: 3\n")});
  EXPECT_EQ(faulty.code, 3);
  EXPECT_THAT(faulty.err, HasSubstr("--spec: verification_points"));
  const Ran set = Remote({"table", "build", "--calibration", "ur10#1", "--allow-draft", "--set",
                          "verification_points=3"});
  EXPECT_THAT(set.err, HasSubstr("--set: verification_points")) << "no --spec was given";
  EXPECT_EQ(Remote({"table", "build"}).code, 2);
  EXPECT_EQ(Remote({"table", "show", "ur10"}).code, 6);
}

// Would catch a build that failed and is reported as done.
TEST_F(TableRemoteTest, AFailedBuildFails) {
  Release();
  const Ran failed = Remote({"table", "build", "--robot", "ur10", "--spec", Spec("seed: 13\n"),
                             "--output", folder_.Path("t.tpct")});
  EXPECT_NE(failed.code, 0);
  EXPECT_THAT(failed.err, HasSubstr("largest_bytes"));
  EXPECT_FALSE(std::filesystem::exists(folder_.Path("t.tpct")));
  EXPECT_THAT(Demand({"table", "list"}).out, HasSubstr("failed"));
}

// Would catch a job that nobody hears of, and a way on that fails again.
TEST_F(TableRemoteTest, ActivationSaysThatATableFollows) {
  EXPECT_THAT(Demand({"calibration", "approve", "ur10#1", "--reason", "looked at"}).out,
              Not(HasSubstr("A table of it")));
  Demand({"robot", "update", "ur10", "--table-spec", Spec("seed: 13\n")});
  const std::vector<std::string> activate = {"calibration", "activate", "ur10#1"};
  EXPECT_THAT(Demand({"calibration", "activate", "ur10#1", "--dry-run"}).out,
              Not(HasSubstr("A table of it")));
  EXPECT_THAT(Demand(activate).out,
              HasSubstr("A table of it is built, by the robot's table_spec. How far it is: "
                        "truepose table list --robot ur10\n"));
  const Ran built = Remote({"table", "build", "--robot", "ur10"});  // waits for that job
  EXPECT_THAT(built.err, HasSubstr("largest_bytes"));
  const auto list = OneObject(Demand({"table", "list", "--json"}).out);
  const std::string shown = Demand({"table", "show", At(list, "compensation_tables.0.name")}).out;
  EXPECT_THAT(shown, HasSubstr("Next: change the spec"));
  EXPECT_THAT(shown, HasSubstr("truepose robot update ur10 --table-spec FILE"));
}

TEST_F(TableRemoteTest, NoTableIsSpokenOfWithoutASpec) {
  Demand({"calibration", "approve", "ur10#1", "--reason", "looked at"});
  EXPECT_THAT(Demand({"calibration", "activate", "ur10#1"}).out, Not(HasSubstr("A table of it")));
}

// Would catch a verdict that limits the calibration and that nobody hears of who builds its table.
TEST_F(TableRemoteTest, AVerdictThatLimitsIsRepeated) {
  Demand({"calibrate", "--robot", "ur10", "--session", kUuid});  // without a control set
  const Ran limited = Demand({"table", "build", "--calibration", "ur10#2", "--allow-draft"});
  EXPECT_THAT(limited.err, HasSubstr("verdict is apply within volume"));
  EXPECT_THAT(Demand({"table", "build", "--calibration", "ur10#1", "--allow-draft"}).err,
              Not(HasSubstr("within volume")));
}

// Would catch an exit code that depends on which of them, or which side, found the verdict.
TEST_F(TableRemoteTest, DoNotApplyIsAFaultOfTheInput) {
  const std::string exact = folder_.Path("exact.csv");
  ASSERT_EQ(RunCli({"simulate", robot_, "--poses", "60", "--length-error-mm", "0",
                    "--angle-error-deg", "0", "--output", exact})
                .code,
            0);
  Demand({"session", "import", exact, "--robot", "ur10", "--session-id", kOtherUuid});
  Demand({"calibrate", "--robot", "ur10", "--session", kOtherUuid, "--split", "even-odd"});
  const std::string program = folder_.Write("p.src", "PTP {A1 1,A2 -80,A3 70,A4 9,A5 50,A6 0}\n");
  for (std::vector<std::string> line : std::vector<std::vector<std::string>>{
           {"compensate", Example("ur10_targets.csv")},
           {"program", "correct", program, "--output", folder_.Path("out.src")},
           {"table", "build", "--allow-draft"},
           {"accuracy-map", "--spec", Example("ur10_cell.yaml")}}) {
    line.insert(line.end(), {"--calibration", "ur10#2"});
    const Ran refused = Remote(line);
    EXPECT_EQ(refused.code, 3) << line[0] << ": " << refused.err;
    EXPECT_THAT(refused.err, HasSubstr("do_not_apply")) << line[0];
  }
}

// Would catch a spec that is set and not followed, or can't be taken away.
TEST_F(TableRemoteTest, ARobotsSpecIsFollowed) {
  Demand(
      {"robot", "update", "ur10", "--table-spec", Spec("seed: 7\nposition_tolerance_mm: 0.05\n")});
  Release();
  const Ran table = Demand({"table", "build", "--robot", "ur10"});
  EXPECT_THAT(table.out, HasSubstr("ready"));
  EXPECT_THAT(Demand({"table", "list", "--json"}).out, HasSubstr(R"("seed":"7")"));
  Demand({"table", "download", "ur10", "--output", folder_.Path("t.tpct")});
  EXPECT_THAT(Written(), HasSubstr("with seed 7"));
  Demand({"robot", "update", "ur10", "--set", "table_spec="});
  EXPECT_THAT(Demand({"robot", "show", "ur10", "--json"}).out, Not(HasSubstr("table_spec")));
}

// Would catch a delete that can't be taken back.
TEST_F(TableRemoteTest, DeleteAndUndelete) {
  Release();
  const Ran built = Demand({"table", "build", "--robot", "ur10"});
  const size_t begin = built.out.find("ur10/");
  const std::string name = built.out.substr(begin, std::string("ur10/").size() + 36);
  const Ran dry = Demand({"table", "delete", name, "--dry-run"});
  EXPECT_EQ(dry.out, "Would delete table " + name + "\nDry run: nothing was changed.\n");
  const Ran there = Remote({"table", "undelete", name.substr(0, 16)});
  EXPECT_EQ(there.code, 6);
  EXPECT_THAT(there.err, HasSubstr("which is not deleted, expected a deleted table"));
  const std::string digits = name.substr(std::string("ur10/").size(), 8);
  EXPECT_THAT(Remote({"table", "undelete", digits}).err,
              HasSubstr("TABLE: found " + digits + ", which is not deleted"));
  const Ran shorter = Remote({"table", "undelete", digits.substr(0, 5)});
  EXPECT_EQ(shorter.code, 3);
  EXPECT_THAT(shorter.err, HasSubstr("which is no robot and too short for a table"));
  Demand({"table", "delete", name});
  EXPECT_THAT(Demand({"table", "list"}).out, HasSubstr("No tables"));
  EXPECT_THAT(Remote({"table", "show", digits}).err, HasSubstr("which is deleted, expected"));
  EXPECT_THAT(Remote({"table", "show", "ur10"}).err, HasSubstr("its table was deleted"));
  EXPECT_THAT(Demand({"table", "undelete", name, "--dry-run"}).out,
              HasSubstr("Dry run: nothing was changed."));
  EXPECT_EQ(Remote({"table", "show", "ur10"}).code, 6);
  Demand({"table", "undelete", name});
  EXPECT_THAT(Demand({"table", "show", "ur10"}).out, HasSubstr(name));
}

// Would catch a command that wants a whole resource name typed, takes a table that was not meant,
// or doesn't say which there are.
TEST_F(TableRemoteTest, TablesHaveShortNames) {
  Release();
  const auto built = [&](const std::string& seed) {
    return OneObject(
        Demand({"table", "build", "--robot", "ur10", "--set", "seed=" + seed, "--json"}).out);
  };
  const auto first = built("1"), second = built("2");
  const auto uuid = [](const std::string& name) { return name.substr(name.size() - 36); };
  const std::string uid = uuid(At(first, "name")), sha256 = At(first, "sha256");
  for (const std::string& name :
       {"ur10/" + uid, "ur10/" + uid.substr(0, 8), uid.substr(0, 8), "ur10/" + sha256.substr(0, 12),
        sha256.substr(0, 12), sha256, At(first, "name")}) {
    EXPECT_THAT(Demand({"table", "show", name}).out, HasSubstr("Table ur10/" + uid)) << name;
  }
  Demand({"table", "download", sha256.substr(0, 10), "--output", folder_.Path("t.tpct")});
  EXPECT_EQ(store::Sha256Hex(Written()), sha256);
  const Ran unknown = Remote({"table", "show", "ur10/ffffff"});
  EXPECT_EQ(unknown.code, 6);
  EXPECT_THAT(unknown.err, HasSubstr("expected ur10/" + uid));
  const Ran two = Remote({"table", "delete", "ur10"});
  EXPECT_EQ(two.code, 3);
  EXPECT_THAT(two.err, HasSubstr("TABLE: found ur10, of which there are 2 tables"));
  EXPECT_THAT(two.err, HasSubstr("ur10/" + uuid(At(second, "name"))));
  Demand({"table", "delete", sha256.substr(0, 12)});
  Demand({"table", "delete", "ur10"});
  EXPECT_THAT(Demand({"table", "list"}).out, HasSubstr("No tables"));
  EXPECT_EQ(Remote({"table", "delete", "ur10"}).code, 6);
  EXPECT_EQ(Remote({"table", "undelete", "ur10"}).code, 3) << "two of them";
  Demand({"table", "undelete", "ur10/" + uid.substr(0, 8)});
  Demand({"table", "undelete", "ur10"});
}

// Would catch a spec that only its job finds out can't be built, and faults in units of nobody's.
TEST_F(TableRemoteTest, AFaultySpecIsRefusedWithTheUnitsThatWereWritten) {
  const Ran zero =
      Remote({"robot", "update", "ur10", "--table-spec", Spec("position_tolerance_mm: 0\n")});
  EXPECT_EQ(zero.code, 3);
  EXPECT_THAT(zero.err, HasSubstr("spec.yaml: position_tolerance_mm: found 0 mm"));
  const Ran set =
      Remote({"robot", "update", "ur10", "--set", "table_spec.position_tolerance_mm=0"});
  EXPECT_EQ(set.code, 3);
  EXPECT_THAT(set.err, HasSubstr("robot.table_spec.position_tolerance_mm: found 0 mm"));
}

}  // namespace
}  // namespace truepose::cli
