// The part `masses` of a robot file: what gravity turns the joints with.
#include <string>
#include <vector>

#include "formats/robot_elements.h"
#include "formats/robot_parts.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

void ReadCentre(YamlMap& map, v1::LinkMass& mass) {
  const Unit* unit = nullptr;
  const size_t before = map.faults().faults.faults().size();
  const YamlNode* node = map.FindWithUnit("center", Dimension::kLength, &unit);
  if (node == nullptr) {
    // A wrong unit is a fault already.
    if (map.faults().faults.faults().size() > before) return;
    map.faults().Add(map.node().line, FieldPath(map.path(), "center_mm"), "no such key",
                     "center_mm or center_m");
    return;
  }
  const std::string path = FieldPath(map.path(), node->key);
  const std::vector<double> p = NumbersOf(*node, path, 3, "x, y, z", map.faults());
  if (p.size() != 3) return;
  mass.set_x_m(unit->to_si(p[0]));
  mass.set_y_m(unit->to_si(p[1]));
  mass.set_z_m(unit->to_si(p[2]));
}

v1::LinkMass ReadMass(const YamlNode& node, const std::string& path, const v1::Nominal& nominal,
                      const YamlFaults& faults) {
  v1::LinkMass mass;
  YamlMap map(node, path, faults);
  if (!map.is_map()) return mass;
  if (const YamlNode* joint = map.FindRequired("joint"))
    mass.set_joint(FindJoint(map, *joint, nominal).value_or(0));
  const auto kilograms = map.FindRequiredMeasure("mass", Dimension::kMass);
  if (kilograms) mass.set_mass_kg(kilograms->value);
  if (kilograms && kilograms->value < 0) map.AddFault("mass_kg", "a negative mass", "0 or more");
  ReadCentre(map, mass);
  map.CheckKeys();
  return mass;
}

}  // namespace

void ReadMasses(YamlMap& top, v1::Nominal& nominal, FieldLines& lines) {
  const YamlNode* node = top.Find("masses");
  if (node == nullptr) return;
  lines.Set("masses", node->line);
  const std::vector<YamlNode>& items = ListItems(*node, "masses", top.faults());
  for (size_t i = 0; i < items.size(); ++i) {
    lines.Set(ItemPath("masses", i), items[i].line);
    *nominal.add_masses() = ReadMass(items[i], ItemPath("masses", i), nominal, top.faults());
  }
}

}  // namespace truepose::formats
