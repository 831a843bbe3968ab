// The parts `geometry`, `joint_map`, `tools` and `masses` of a robot file.
#pragma once

#include "formats/field_lines.h"
#include "formats/yaml_map.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

// Each reads one key of the file's top map into `nominal`, whose joints are read already, and notes
// the lines of the message's fields. Faults go to the map's list; the part is then of no use.
void ReadGeometry(YamlMap& top, v1::Nominal& nominal, FieldLines& lines);
void ReadJointMap(YamlMap& top, v1::Nominal& nominal, FieldLines& lines);
void ReadTools(YamlMap& top, v1::Nominal& nominal, FieldLines& lines);
void ReadMasses(YamlMap& top, v1::Nominal& nominal, FieldLines& lines);

}  // namespace truepose::formats
