// What a compensation table may be asked, and how requests are told apart.
#include "convert/table_spec.h"

#include <gmock/gmock.h>
#include <google/protobuf/text_format.h>

#include "absl/strings/str_cat.h"
#include "convert/run.h"
#include "convert/table_domain.h"
#include "core/base/fault.h"

namespace truepose::convert {
namespace {

using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

v1::CompensationTableSpec Spec(const std::string& text) {
  v1::CompensationTableSpec spec;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &spec)) << text;
  return spec;
}

std::vector<std::string> Fields(const absl::Status& status) {
  std::vector<std::string> fields;
  for (const Fault& fault : FaultsOf(status)) fields.push_back(fault.field);
  return fields;
}

// A box, with more of its fields as text.
std::string Box(const std::string& more = "") {
  return "box { min_x_m: 0 min_y_m: 0 min_z_m: 0 max_x_m: 1 max_y_m: 1 max_z_m: 1 cone_rad: 0.5 "
         "reference_joints: [0, 0, 0, 0, 0] " +
         more + " }";
}

// Would catch a default that is refused, and a box that a plant asks for.
TEST(TableSpec, TheUsualIsAccepted) {
  for (const std::string& text :
       {std::string(), Box(), std::string("position_tolerance_m: 1e-4 seed: 3")}) {
    EXPECT_TRUE(ValidateTableSpec(MeasuringRobot(), Spec(text)).ok()) << text;
  }
}

// Would catch a fault that only the second answer tells, and a number that gets to the builder as
// it is.
TEST(TableSpec, EveryFaultComesAtOnce) {
  const auto spec = Spec(
      "box { min_x_m: 1 max_x_m: 0 min_y_m: 0 max_y_m: nan max_z_m: 1 cone_rad: 4 approach_x: 2 "
      "min_roll_rad: 1 max_roll_rad: 0.5 } position_tolerance_m: -1 rotation_tolerance_rad: 1e-12 "
      "smallest_singular_value: 1 verification_points: 10 largest_bytes: 1000000000");
  EXPECT_THAT(
      Fields(ValidateTableSpec(spec)),
      UnorderedElementsAre("box.max_x_m", "box.max_y_m", "box.max_y_m", "box.min_z_m",
                           "box.cone_rad", "box.approach_x", "box.max_roll_rad",
                           "box.reference_joints", "position_tolerance_m", "rotation_tolerance_rad",
                           "smallest_singular_value", "verification_points", "largest_bytes"));
}

// Would catch an edge that nobody gave and that counts as 0.
TEST(TableSpec, EveryEdgeOfABoxIsGiven) {
  for (const char* edge : {"min_x_m", "min_y_m", "min_z_m", "max_x_m", "max_y_m", "max_z_m"}) {
    v1::CompensationTableSpec spec = Spec(Box());
    const auto* field = v1::BoxDomain::descriptor()->FindFieldByName(edge);
    spec.mutable_box()->GetReflection()->ClearField(spec.mutable_box(), field);
    EXPECT_THAT(Fields(ValidateTableSpec(spec)), UnorderedElementsAre(std::string("box.") + edge));
    const auto stored = StoredTableSpec(spec);
    EXPECT_TRUE(ValidateTableSpec(stored).ok() == std::string(edge).starts_with("min"))
        << edge << ": 0 to 0 is no range";
    EXPECT_EQ(TableInputDigest("c", "n", spec), TableInputDigest("c", "n", stored));
  }
}

// Would catch a tolerance of nothing that silently becomes the default.
TEST(TableSpec, TolerancesAreAboveZero) {
  for (const char* given : {"0", "-1", "-0.0", "inf", "nan", "2"}) {
    EXPECT_THAT(Fields(ValidateTableSpec(Spec(absl::StrCat("position_tolerance_m: ", given)))),
                UnorderedElementsAre("position_tolerance_m"))
        << given;
    EXPECT_THAT(Fields(ValidateTableSpec(Spec(absl::StrCat("rotation_tolerance_rad: ", given)))),
                UnorderedElementsAre("rotation_tolerance_rad"))
        << given;
  }
}

// Would catch a range beyond what the joint can do, or for another robot.
TEST(TableSpec, MustFitTheRobot) {
  v1::Nominal nominal = MeasuringRobot();
  for (v1::Joint& joint : *nominal.mutable_joints()) {
    joint.set_lower(-1);
    joint.set_upper(1);
  }
  std::string ranges = "joint_ranges { joints { lower: -2 upper: 0 } joints { lower: 0 upper: 2 } ";
  EXPECT_THAT(Fields(ValidateTableSpec(nominal, Spec(ranges + "}"))),
              UnorderedElementsAre("joint_ranges.joints", "joint_ranges.joints[0].lower",
                                   "joint_ranges.joints[1].upper"));
  v1::CompensationTableSpec box = Spec(Box());
  box.mutable_box()->add_reference_joints(0);
  box.mutable_box()->set_tool("torch");
  EXPECT_THAT(Fields(ValidateTableSpec(nominal, box)),
              UnorderedElementsAre("box.reference_joints", "box.tool"));
}

// Would catch a table that is taken for another one, and one that is built twice because a default
// is written out.
TEST(TableSpec, DigestsTellSpecsApart) {
  const auto digest = [](const std::string& text) {
    return TableInputDigest("calibration", "nominal", Spec(text));
  };
  const std::string standard = digest("");
  EXPECT_EQ(digest("position_tolerance_m: 2e-5 verification_points: 10000"), standard);
  EXPECT_EQ(digest(Box()), digest(Box("approach_z: -1")));
  std::set<std::string> all = {standard, TableInputDigest("other", "nominal", {}),
                               TableInputDigest("calibration", "other", {})};
  const std::vector<std::string> others = {"seed: 1",
                                           "position_tolerance_m: 3e-5",
                                           "rotation_tolerance_rad: 1e-4",
                                           "smallest_singular_value: 0.1",
                                           "verification_points: 2000",
                                           "largest_bytes: 1000",
                                           "joint_ranges { joints { lower: 0 upper: 1 } }",
                                           "joint_ranges { joints { lower: 0 upper: 2 } }",
                                           Box(),
                                           Box("tool: \"torch\""),
                                           Box("min_roll_rad: -1 max_roll_rad: 1")};
  for (const std::string& text : others) all.insert(digest(text));
  EXPECT_EQ(all.size(), 3 + others.size());
}

// Would catch a spec that only its job finds out can't be built: beyond where the arm reaches, in a
// configuration that it can't take.
TEST(TableDomain, TheNominalChainTellsWhatCannotBe) {
  const v1::Nominal nominal = MeasuringRobot();
  EXPECT_TRUE(CheckTableDomain(nominal, {}).ok());
  EXPECT_TRUE(CheckTableDomain(nominal, Spec(Box("approach_x: 1"))).ok())
      << CheckTableDomain(nominal, Spec(Box("approach_x: 1")));
  v1::CompensationTableSpec far = Spec(Box());
  far.mutable_box()->set_min_x_m(100);
  far.mutable_box()->set_max_x_m(101);
  EXPECT_THAT(Fields(CheckTableDomain(nominal, far)), UnorderedElementsAre("box"));
  v1::Nominal limited = nominal;
  limited.mutable_joints(1)->set_lower(-1);
  limited.mutable_joints(1)->set_upper(1);
  v1::CompensationTableSpec bent = Spec(Box());
  bent.mutable_box()->set_reference_joints(1, 2);
  EXPECT_THAT(Fields(CheckTableDomain(limited, bent)),
              UnorderedElementsAre("box.reference_joints[1]"));
  // Catches: numbers of which nobody knows the unit.
  EXPECT_THAT(std::string(CheckTableDomain(limited, bent).message()),
              HasSubstr("found 2 rad, expected within the joint's limits -1 to 1 rad"));
}

}  // namespace
}  // namespace truepose::convert
