// Lists of elementary transforms in a robot file, `chain` and `flange`, and how it names joints.
#pragma once

#include <optional>
#include <set>
#include <string>

#include "formats/field_lines.h"
#include "formats/yaml_map.h"
#include "google/protobuf/repeated_ptr_field.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::formats {

// The form of an element: translation or rotation, along or about which axis.
struct ElementForm;

// The joint, counted from 0, that a node of `map` names or numbers (from 1). A fault and nullopt
// when there is no such joint; without any joints there is a fault already.
std::optional<int> FindJoint(const YamlMap& map, const YamlNode& node, const v1::Nominal& nominal);

// Reads the lists of one robot, whose joints are read already, and remembers which joints they
// move.
class ElementReader {
 public:
  using Elements = google::protobuf::RepeatedPtrField<v1::ElementaryTransform>;

  // All arguments have to outlive the reader.
  ElementReader(const v1::Nominal& nominal, const YamlFaults& faults, FieldLines& lines)
      : nominal_(nominal), faults_(faults), lines_(lines) {}

  // @param path of the list in the file; `message_path` of its elements in the message.
  // @param with_joints false: the list has constants only.
  void ReadList(const YamlNode& node, const std::string& path, const std::string& message_path,
                bool with_joints, Elements* elements);

  // A fault for each joint that no element of the chain moves.
  void CheckAllJoints(const YamlNode& chain, const std::string& path) const;

 private:
  v1::ElementaryTransform ReadElement(const YamlNode& node, const std::string& path,
                                      bool with_joints);
  bool ReadForm(YamlMap& map, const ElementForm& form, bool with_joints,
                v1::ElementaryTransform& element);
  bool IsUsable(const YamlMap& map, const YamlNode& node, int index, const ElementForm& form);

  const v1::Nominal& nominal_;
  const YamlFaults& faults_;
  FieldLines& lines_;
  std::set<int> used_;
};

}  // namespace truepose::formats
