#include <algorithm>
#include <array>
#include <functional>
#include <iterator>
#include <utility>

#include "formats/csv.h"
#include "formats/known_column.h"
#include "formats/number.h"
#include "formats/session_file.h"
#include "formats/strings.h"

namespace truepose::formats {
namespace {

using Names = std::vector<std::string>;
using Cells = std::vector<std::string>;
using Readings = std::vector<v1::Reading>;

// Columns that stand or fall together, and their cells of a reading; no cells when the reading has
// none of it.
struct Field {
  Names names;
  std::function<Cells(const v1::Reading&)> cells;
};

Names JointNames(const v1::Nominal& nominal, std::string_view infix) {
  Names names;
  for (const v1::Joint& joint : nominal.joints()) {
    const std::string_view unit = joint.type() == v1::PRISMATIC ? "_m" : "_rad";
    names.push_back(StrCat("q", names.size() + 1, infix, unit));
  }
  return names;
}

Names TorqueNames(const v1::Nominal& nominal) {
  Names names;
  for (int i = 1; i <= nominal.joints_size(); ++i) names.push_back(StrCat("tau", i, "_Nm"));
  return names;
}

template <class Numbers>
Cells CellsOf(const Numbers& numbers) {
  Cells cells;
  for (const double number : numbers) cells.push_back(FormatNumber(number));
  return cells;
}

Cells CellsOf(const v1::Vector3& v) { return CellsOf(std::array{v.x(), v.y(), v.z()}); }

Cells CellsOf(const v1::Quaternion& q) { return CellsOf(std::array{q.x(), q.y(), q.z(), q.w()}); }

Cells CellsOf(const std::string& text) { return text.empty() ? Cells() : Cells{text}; }

void AddJointFields(const v1::Nominal& nominal, std::vector<Field>& fields) {
  using R = v1::Reading;
  fields.push_back(
      {JointNames(nominal, ""), [](const R& r) { return CellsOf(r.joints_measured()); }});
  fields.push_back(
      {JointNames(nominal, "_cmd"), [](const R& r) { return CellsOf(r.joints_commanded()); }});
  fields.push_back(
      {TorqueNames(nominal), [](const R& r) { return CellsOf(r.joint_torques_nm()); }});
}

void AddTextFields(std::vector<Field>& fields) {
  using R = v1::Reading;
  fields.push_back({{"time"}, [](const R& r) { return CellsOf(r.time()); }});
  fields.push_back({{"placement"}, [](const R& r) { return CellsOf(r.placement()); }});
  fields.push_back({{"target"}, [](const R& r) { return CellsOf(r.target()); }});
  fields.push_back({{"group"}, [](const R& r) { return CellsOf(r.group()); }});
}

// Coordinates that were not measured stay empty, and so do their deviations.
Cells CellsOfMeasured(const v1::Vector3& v, const std::string& coordinates) {
  Cells cells = CellsOf(v);
  for (size_t i = 0; i < cells.size() && !coordinates.empty(); ++i) {
    if (coordinates.find("xyz"[i]) == std::string::npos) cells[i].clear();
  }
  return cells;
}

const v1::MeasuredPoint* FindPoint(const v1::Reading& reading, const std::string& target) {
  const auto it = std::find_if(reading.points().begin(), reading.points().end(),
                               [&](const auto& point) { return point.target() == target; });
  return it == reading.points().end() ? nullptr : &*it;
}

void AddPointFields(const std::string& target, std::vector<Field>& fields) {
  const auto names = [&](std::string_view infix) {
    return Names{StrCat(target, infix, "x_m"), StrCat(target, infix, "y_m"),
                 StrCat(target, infix, "z_m")};
  };
  fields.push_back({names("_"), [target](const v1::Reading& r) {
                      const v1::MeasuredPoint* point = FindPoint(r, target);
                      return point ? CellsOf(point->position_m()) : Cells();
                    }});
  fields.push_back({names("_s"), [target](const v1::Reading& r) {
                      const v1::MeasuredPoint* point = FindPoint(r, target);
                      return point && point->has_position_sd_m() ? CellsOf(point->position_sd_m())
                                                                 : Cells();
                    }});
}

void AddFurtherFields(std::vector<Field>& fields) {
  using R = v1::Reading;
  for (int point = 1; point <= kMostPoints; ++point) AddPointFields(StrCat("p", point), fields);
  fields.push_back({{"distance_m"}, [](const R& r) {
                      return r.has_distance_m() ? CellsOf(std::array{r.distance_m()}) : Cells();
                    }});
  fields.push_back({{"distance_sd_m"}, [](const R& r) {
                      return r.has_distance_sd_m() ? CellsOf(std::array{r.distance_sd_m()})
                                                   : Cells();
                    }});
  fields.push_back({{"anchor"}, [](const R& r) { return CellsOf(r.anchor()); }});
  fields.push_back({{"beam"}, [](const R& r) { return CellsOf(r.beam()); }});
  fields.push_back({{"feature"}, [](const R& r) { return CellsOf(r.feature()); }});
}

void AddMeasurementFields(std::vector<Field>& fields) {
  using R = v1::Reading;
  fields.push_back({{"x_m", "y_m", "z_m"}, [](const R& r) {
                      return r.has_position_m() ? CellsOfMeasured(r.position_m(), r.coordinates())
                                                : Cells();
                    }});
  fields.push_back({{"qx", "qy", "qz", "qw"}, [](const R& r) {
                      return r.has_orientation() ? CellsOf(r.orientation()) : Cells();
                    }});
  fields.push_back({{"axis_x", "axis_y", "axis_z"},
                    [](const R& r) { return r.has_axis() ? CellsOf(r.axis()) : Cells(); }});
  fields.push_back({{"sx_m", "sy_m", "sz_m"}, [](const R& r) {
                      return r.has_position_sd_m()
                                 ? CellsOfMeasured(r.position_sd_m(), r.coordinates())
                                 : Cells();
                    }});
  fields.push_back({{"temp_C"}, [](const R& r) {
                      return r.has_temperature_c() ? CellsOf(std::array{r.temperature_c()})
                                                   : Cells();
                    }});
}

// Extra columns stay even when they are empty: they are part of the session.
Field ExtraField(const v1::Session& session) {
  return {
      Names(session.extra_columns().begin(), session.extra_columns().end()),
      [](const v1::Reading& r) { return Cells(r.extra_values().begin(), r.extra_values().end()); }};
}

std::vector<Field> UsedFields(const v1::Nominal& nominal, const v1::Session& session,
                              const Readings& readings) {
  std::vector<Field> fields;
  AddTextFields(fields);
  AddJointFields(nominal, fields);
  AddMeasurementFields(fields);
  AddFurtherFields(fields);
  std::erase_if(fields, [&](const Field& field) {
    return std::all_of(readings.begin(), readings.end(),
                       [&](const v1::Reading& reading) { return field.cells(reading).empty(); });
  });
  fields.push_back(ExtraField(session));
  return fields;
}

void Append(const Field& field, Cells cells, Cells& line) {
  cells.resize(field.names.size());
  std::move(cells.begin(), cells.end(), std::back_inserter(line));
}

}  // namespace

std::string WriteSessionFile(const v1::Nominal& nominal, const v1::Session& session,
                             const std::vector<v1::Reading>& readings) {
  const std::vector<Field> fields = UsedFields(nominal, session, readings);
  Cells header;
  for (const Field& field : fields) Append(field, field.names, header);
  std::string text = CsvLine(header);
  for (const v1::Reading& reading : readings) {
    Cells line;
    for (const Field& field : fields) Append(field, field.cells(reading), line);
    text += CsvLine(line);
  }
  return text;
}

}  // namespace truepose::formats
