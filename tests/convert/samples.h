// A small robot and simulated sessions of it as messages.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "convert/run.h"

namespace truepose::convert {

// The measuring robot with a sixth joint and limits: enough kinematics for a full pose.
inline v1::Nominal SampleNominal() {
  v1::Nominal nominal = MeasuringRobot();
  nominal.set_kind(v1::INDUSTRIAL);
  v1::Joint* joint = nominal.add_joints();
  joint->set_name("joint6");
  joint->set_type(v1::REVOLUTE);
  nominal.mutable_geometry()->mutable_standard_dh()->add_rows()->set_d_m(0.1);
  // Off the last axis: on it a point shows two parameters less.
  nominal.mutable_tools(0)->mutable_pose()->set_x_m(0.05);
  nominal.mutable_tools(0)->mutable_pose()->set_y_m(0.03);
  for (v1::Joint& limited : *nominal.mutable_joints()) {
    limited.set_lower(-3);
    limited.set_upper(3);
  }
  return nominal;
}

inline v1::CalibrationInput SampleInput(int poses = 60, const std::string& split = "even-odd") {
  v1::CalibrationInput input;
  *input.mutable_nominal() = SampleNominal();
  input.mutable_options()->set_split(split);
  SimulationOptions options;
  options.poses = poses;
  const auto simulation = RunSimulation(input.nominal(), options);
  EXPECT_TRUE(simulation.ok()) << simulation.status();
  *input.add_sessions() = simulation->session;
  return input;
}

}  // namespace truepose::convert
