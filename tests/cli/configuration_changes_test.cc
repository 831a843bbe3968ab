#include "client/cli/configuration_changes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <string>

namespace truepose::cli {
namespace {

using ::testing::HasSubstr;

// A path along x, with joint 2 at each pose.
class ConfigurationChanges : public ::testing::Test {
 protected:
  void Add(double x_m, double joint_2, bool hinted = false) {
    v1::CompensationTarget* target = request_.add_targets();
    target->mutable_pose()->set_x_m(x_m);
    if (hinted) target->add_joints(0);
    v1::CompensatedTarget* result = response_.add_targets();
    result->set_row(request_.targets_size());
    result->add_joints(0.1);
    result->add_joints(joint_2);
    result->mutable_pose()->set_x_m(x_m);
    result->mutable_pose()->set_qw(1);
  }
  std::string Warning() {
    v1::Nominal nominal;
    for (const char* name : {"shoulder", "elbow"}) {
      nominal.add_joints()->set_name(name);
      nominal.mutable_joints()->rbegin()->set_type(v1::REVOLUTE);
    }
    std::ostringstream out, err;
    Console console{out, err};
    WarnOfConfigurationChanges(console, nominal, request_, response_);
    return err.str();
  }

  v1::CompensateRequest request_;
  v1::CompensateResponse response_;
};

// Would catch an arm that turns over between two poses without a word.
TEST_F(ConfigurationChanges, AreSaidOnceWithRowJointAndAngle) {
  Add(0, 0.2);
  Add(0.05, 2.2);
  Add(0.10, 0.2);
  EXPECT_THAT(Warning(),
              HasSubstr("the arm turns over 2 times on this path; first before target 2, "
                        "where joint elbow turns by 115 deg"));
}

// Would catch warnings of what was asked for: far poses, joints that were given, small turns.
TEST_F(ConfigurationChanges, OrdinaryPathsAreNotWarnedOf) {
  Add(0, 0.2);
  Add(0.05, 1.7);
  Add(0.50, -1.2);
  Add(0.55, 2.2, true);
  EXPECT_EQ(Warning(), "");
}

}  // namespace
}  // namespace truepose::cli
