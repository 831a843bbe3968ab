// Instruments, tools and so on, and what robots and sessions have in common with them.
#include <gmock/gmock.h>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "tests/cli/remote_fixture.h"

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using ResourceTest = RemoteFixture;

// One life of each kind: would catch a kind whose methods, fields or names are not found by their
// descriptors.
TEST_F(ResourceTest, EachKindHasAWholeLife) {
  AddRobot();
  const std::string poses = folder_.Write("p.csv",
                                          "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n"
                                          "0,-90,90,0,90,0\n10,-90,90,0,90,0\n");
  const std::vector<std::vector<std::string>> creates = {
      {"instrument", "lt-1", "--set", "serial=4711", "position_sd_mm=0.02"},
      {"tool", "gripper-2", "--set", "pose.z_mm=145.5", "mass_kg=1.2"},
      {"fixture", "sockets", "--features", Example("sockets.yaml")},
      {"target", "smr-a", "--set", "pose.x_mm=25"},
      {"placement", "ur10/floor-a", "--set", "instrument=instruments/lt-1"},
      {"pose-set", "ur10/daily", "--set", "purpose=POSE_SET_CHECK", "--poses", poses}};
  for (std::vector<std::string> line : creates) {
    const std::string kind = line[0], name = line[1];
    line.insert(line.begin() + 1, "create");
    Demand(line);
    EXPECT_THAT(Demand({kind, "list"}).out, HasSubstr(name));
    Demand({kind, "update", name, "--set", "display_name=Hall 3: left"});
    EXPECT_THAT(Demand({kind, "show", name}).out, HasSubstr("Hall 3: left"));
    EXPECT_THAT(Demand({kind, "delete", name}).out,
                HasSubstr(absl::StrCat("truepose ", kind, " undelete ", name)));
    EXPECT_THAT(Demand({kind, "list"}).out, Not(HasSubstr("Hall 3")));
    EXPECT_THAT(Demand({kind, "list", "--show-deleted"}).out, HasSubstr("Hall 3"));
    Demand({kind, "undelete", name});
    EXPECT_THAT(Demand({kind, "list", "--filter", "display_name = \"Hall*\""}).out,
                HasSubstr(name));
  }
}

// Would catch lengths that arrive as other lengths, and angles in degrees that are stored so.
TEST_F(ResourceTest, UnitsForPeopleAreSiOnTheServer) {
  const auto made = OneObject(
      Demand({"instrument", "create", "lt-1", "--set", "position_sd_mm=0.02",
              "rotation_sd_deg=0.01", "certificate_expire_time=2027-03-01T00:00:00Z", "--json"})
          .out);
  EXPECT_EQ(At(made, "position_sd_m"), "2e-05");
  EXPECT_EQ(At(made, "rotation_sd_rad").substr(0, 10), "0.00017453");
  const std::string shown = Demand({"instrument", "show", "lt-1"}).out;
  EXPECT_THAT(shown, HasSubstr("position_sd_mm           0.02\n"));
  EXPECT_THAT(shown, HasSubstr("rotation_sd_deg          0.01\n"));
  EXPECT_THAT(shown, HasSubstr("2027-03-01T00:00:00Z"));
}

// Would catch a file that is read otherwise than flags, and JSON that is refused as YAML.
TEST_F(ResourceTest, FilesAreYamlOrJson) {
  const std::string yaml = folder_.Write("i.yaml", "serial: '4711'\nposition_sd_mm: 0.02\n");
  const std::string json =
      folder_.Write("i.json", "{\"serial\": \"4711\", \"position_sd_m\": 0.00002}");
  Demand({"instrument", "create", "a", "--file", yaml});
  // The same content again is the same instrument.
  Demand({"instrument", "create", "a", "--file", json});
  EXPECT_EQ(Remote({"instrument", "create", "a", "--set", "serial=1"}).code, 3);
}

// Would catch faults told one by one, without their line or key, or only by the server.
TEST_F(ResourceTest, EveryFaultIsNamed) {
  const std::string bad =
      folder_.Write("bad.yaml", "serial: 4711\nposition_sd_in: 1\nrotation_sd_rad: much\n");
  const Ran of_file = Remote({"instrument", "create", "a", "--file", bad});
  EXPECT_EQ(of_file.code, 3);
  EXPECT_THAT(of_file.err, HasSubstr("bad.yaml:2: position_sd_in"));
  EXPECT_THAT(of_file.err, HasSubstr("bad.yaml:3: rotation_sd_rad"));
  const Ran of_key = Remote({"instrument", "create", "a", "--set", "seral=1", "position_sd_mm=x"});
  EXPECT_THAT(of_key.err, HasSubstr("--set 'seral'"));
  EXPECT_THAT(of_key.err, HasSubstr("serial"));
  EXPECT_THAT(of_key.err, HasSubstr("--set position_sd_mm"));
  EXPECT_THAT(Remote({"instrument", "create", "a", "--set", "serial"}).err, HasSubstr("KEY=VALUE"));
  const Ran of_server = Remote({"instrument", "create", "a", "--set", "position_sd_mm=-1"});
  EXPECT_EQ(of_server.code, 3);
  EXPECT_THAT(of_server.err, HasSubstr("position_sd_m"));
  EXPECT_EQ(Remote({"instrument", "update", "a"}).code, 2) << "nothing to change";
  EXPECT_EQ(Remote({"placement", "create", "floor-a"}).code, 3) << "of which robot?";
}

// Would catch an update that changes more than was asked for, or by somebody who has not seen what
// is there; and a dry run that is none.
TEST_F(ResourceTest, UpdatesChangeWhatTheyName) {
  Demand({"instrument", "create", "a", "--set", "serial=1", "model=AT960"});
  const auto before = OneObject(Demand({"instrument", "show", "a", "--json"}).out);
  Demand({"instrument", "update", "a", "--set", "serial=2", "--dry-run"});
  EXPECT_THAT(Demand({"instrument", "delete", "a", "--dry-run"}).out,
              AllOf(HasSubstr("Dry run: nothing was changed."), Not(HasSubstr("brings it back"))));
  const auto after_dry = OneObject(Demand({"instrument", "show", "a", "--json"}).out);
  EXPECT_EQ(At(after_dry, "etag"), At(before, "etag"));
  Demand({"instrument", "update", "a", "--set", "serial=2", "--etag", At(before, "etag")});
  const auto after = OneObject(Demand({"instrument", "show", "a", "--json"}).out);
  EXPECT_EQ(At(after, "serial"), "2");
  EXPECT_EQ(At(after, "model"), "AT960");
  const Ran late =
      Remote({"instrument", "update", "a", "--set", "serial=3", "--etag", At(before, "etag")});
  EXPECT_EQ(late.code, 1);
  EXPECT_THAT(late.err, HasSubstr("get it again"));
  Demand({"instrument", "update", "a", "--set", "model="});
  EXPECT_EQ(At(OneObject(Demand({"instrument", "show", "a", "--json"}).out), "model"), "");
}

// Would catch a file of `show --json` that can't be edited and given back, and one that overwrites
// what somebody else has changed since.
TEST_F(ResourceTest, WhatIsShownCanBeEditedAndGivenBack) {
  Demand({"tool", "create", "g", "--set", "pose.z_mm=145.5", "mass_kg=1.2"});
  const std::string shown = Demand({"tool", "show", "g", "--json"}).out;
  const std::string edited =
      folder_.Write("g.json", absl::StrReplaceAll(shown, {{"\"mass_kg\":1.2", "\"mass_kg\":1.3"}}));
  EXPECT_EQ(
      At(OneObject(Demand({"tool", "update", "g", "--file", edited, "--json"}).out), "mass_kg"),
      "1.3");
  const Ran late = Remote({"tool", "update", "g", "--file", edited});
  EXPECT_EQ(late.code, 1) << "its etag is that of the state before";
  EXPECT_EQ(Remote({"tool", "update", "g", "--set", "version=7"}).code, 3);
}

// Would catch robots and sessions that can't be changed as the others can.
TEST_F(ResourceTest, RobotsAndSessionsChangeTheSameWay) {
  AddRobot();
  Import();
  Demand(
      {"robot", "update", "ur10", "--set", "release_policy=ONE_PERSON", "limits.drift_rms_mm=0.3"});
  EXPECT_EQ(At(OneObject(Demand({"robot", "show", "ur10", "--json"}).out), "release_policy"),
            "ONE_PERSON");
  EXPECT_THAT(Demand({"robot", "list", "--filter", "release_policy = \"TWO_PERSON\""}).out,
              Not(HasSubstr("ur10")));
  const Ran sealed = Remote({"session", "update", kUuid, "--set", "operator=A. Smith"});
  EXPECT_EQ(sealed.code, 1);
  EXPECT_THAT(sealed.err, HasSubstr("sealed"));
  Demand({"session", "delete", kUuid});
  EXPECT_THAT(Demand({"session", "list"}).out, Not(HasSubstr(kUuid)));
  EXPECT_THAT(Demand({"session", "list", "--show-deleted"}).out, HasSubstr(kUuid));
  Demand({"session", "undelete", kUuid});
  EXPECT_THAT(Demand({"session", "list", "--filter", "state = \"SEALED\""}).out, HasSubstr(kUuid));
  const Ran wrong = Remote({"session", "list", "--filter", "colour = 1"});
  EXPECT_EQ(wrong.code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("--filter"));
  Demand({"robot", "delete", "ur10"});
  EXPECT_THAT(Demand({"robot", "list", "--show-deleted"}).out, HasSubstr("ur10"));
  Demand({"robot", "undelete", "ur10"});
}

// Would catch a dead end at a name that is not there.
TEST_F(ResourceTest, UnknownNamesSayHowToList) {
  const Ran ran = Remote({"tool", "show", "none"});
  EXPECT_EQ(ran.code, 6);
  EXPECT_THAT(ran.err, HasSubstr("truepose tool list"));
}

}  // namespace
}  // namespace truepose::cli
