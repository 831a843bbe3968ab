// What begins a session, as a JSON object.
#pragma once

#include <string>

#include "client/agent/lines/json_fields.h"
#include "client/agent/source.h"

namespace truepose::agent {

// `text` with `prefix` before it unless it has that or is empty.
std::string LongName(const std::string& text, const char* prefix);

// robots/{robot} of the key `robot`, long or short; a fault when it is not there.
std::string RobotFromJson(JsonFields& fields);

// Keys: robot, purpose (calibration, check), source, display_name, instrument, fixture, operator,
// joint_source, placement, temperature_c, load_kg, extra_columns; id; request (true: the session
// answers the robot's open request). What is wrong is in the faults of `fields`.
SessionStart StartFromJson(JsonFields& fields);

}  // namespace truepose::agent
