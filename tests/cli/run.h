// The program as tests call it: arguments in, exit code and both streams out.
#pragma once

#include <string>
#include <vector>

#include "google/protobuf/struct.pb.h"

namespace truepose::cli {

struct Ran {
  int code = 0;
  std::string out;
  std::string err;
};

// No terminal, no colour, ASCII.
Ran RunCli(const std::vector<std::string>& arguments);

// `text` as exactly one JSON object with a line end; a failure of the running test otherwise.
google::protobuf::Struct OneObject(const std::string& text);

// "error.faults.0.field" in an object; "" and a failure of the running test when it is not there.
// Numbers and flags as JSON prints them.
std::string At(const google::protobuf::Struct& object, const std::string& path);

std::string TextOf(const std::string& path);

// deploy/examples/NAME
std::string Example(const std::string& name);

}  // namespace truepose::cli
