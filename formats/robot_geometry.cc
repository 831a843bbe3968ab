#include <string>
#include <vector>

#include "formats/robot_elements.h"
#include "formats/robot_parts.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

std::string CountOfJoints(const v1::Nominal& nominal) {
  return StrCat(nominal.joints_size(), ", one for each of the joints");
}

v1::DhRow ReadDhRow(const YamlNode& node, const std::string& path, const YamlFaults& faults) {
  v1::DhRow row;
  YamlMap map(node, path, faults);
  const auto read = [&](std::string_view stem, Dimension dimension) {
    return map.FindRequiredMeasure(stem, dimension).value_or(YamlNumber()).value;
  };
  row.set_theta_rad(read("theta", Dimension::kAngle));
  row.set_d_m(read("d", Dimension::kLength));
  row.set_a_m(read("a", Dimension::kLength));
  row.set_alpha_rad(read("alpha", Dimension::kAngle));
  map.CheckKeys();
  return row;
}

void ReadDhTable(const YamlNode& node, const std::string& path, const v1::Nominal& nominal,
                 const YamlFaults& faults, FieldLines& lines, v1::DhTable* table) {
  const std::string rows = FieldPath(path, "rows");
  lines.Set(path, node.line);
  const std::vector<YamlNode>& items = ListItems(node, path, faults);
  for (size_t i = 0; i < items.size(); ++i) {
    lines.Set(ItemPath(rows, i), items[i].line);
    *table->add_rows() = ReadDhRow(items[i], ItemPath(path, i), faults);
  }
  if (node.kind != YamlNode::Kind::kSequence) return;
  // Without joints there is a fault already.
  if (static_cast<int>(items.size()) == nominal.joints_size() || nominal.joints_size() == 0) return;
  faults.Add(node.line, path, StrCat(items.size(), " rows"), CountOfJoints(nominal));
}

void ReadConvention(YamlMap& map, const v1::Nominal& nominal, FieldLines& lines,
                    ElementReader& elements, v1::Geometry& geometry) {
  if (const YamlNode* node = map.Find("standard_dh")) {
    ReadDhTable(*node, "geometry.standard_dh", nominal, map.faults(), lines,
                geometry.mutable_standard_dh());
  }
  if (const YamlNode* node = map.Find("craig_dh")) {
    ReadDhTable(*node, "geometry.craig_dh", nominal, map.faults(), lines,
                geometry.mutable_craig_dh());
  }
  if (const YamlNode* node = map.Find("chain")) {
    elements.ReadList(*node, "geometry.chain", "geometry.chain.elements", true,
                      geometry.mutable_chain()->mutable_elements());
    elements.CheckAllJoints(*node, "geometry.chain");
  }
}

}  // namespace

void ReadGeometry(YamlMap& top, v1::Nominal& nominal, FieldLines& lines) {
  const YamlNode* node = top.FindRequired("geometry");
  if (node == nullptr) return;
  lines.Set("geometry", node->line);
  YamlMap map(*node, "geometry", top.faults());
  if (!map.is_map()) return;
  ElementReader elements(nominal, top.faults(), lines);
  v1::Geometry geometry;
  ReadConvention(map, nominal, lines, elements, geometry);
  const int found = (map.Find("standard_dh") != nullptr) + (map.Find("craig_dh") != nullptr) +
                    (map.Find("chain") != nullptr);
  if (found != 1) {
    top.AddFault("geometry", StrCat(found, " of standard_dh, craig_dh and chain"), "one of them");
  }
  if (const YamlNode* flange = map.Find("flange")) {
    elements.ReadList(*flange, "geometry.flange", "geometry.flange", false,
                      geometry.mutable_flange());
  }
  map.CheckKeys();
  *nominal.mutable_geometry() = geometry;
}

}  // namespace truepose::formats
