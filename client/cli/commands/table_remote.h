// truepose table on a server: tables as resources, built by jobs and downloaded by name.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "client/cli/command_line.h"
#include "truepose/v1/compensation_table.pb.h"

namespace truepose::cli {

// What a table is to be made of there.
struct RemoteTable {
  std::string robot;        // "" = the calibration's
  std::string calibration;  // such as ur10#1; "" = the robot's active one
  v1::CompensationTableSpec spec;
  bool has_spec = false;   // else the robot's table_spec
  std::string spec_place;  // before each fault of the spec
  bool allow_draft = false, no_wait = false;
  std::string output;  // "" = it stays there
};

// Waits for the job, with a bar; with an output the file is fetched and checked.
absl::Status BuildTableOnServer(const Invocation& invocation, const RemoteTable& wanted);
absl::Status EstimateTableOnServer(const Invocation& invocation, const RemoteTable& wanted);

// @param typed "ur10/UUID", the resource's name, or "ur10" for the one to apply on that robot.
absl::Status ShowTableOnServer(const Invocation& invocation, const std::string& typed);

// list, download, delete, undelete.
void AddTableOnServer(const Command& table);

}  // namespace truepose::cli
