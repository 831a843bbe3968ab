#include "client/agent/lines/reading_json.h"

#include <cmath>
#include <numbers>

#include "absl/strings/str_cat.h"
#include "absl/time/time.h"

namespace truepose::agent {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kMillimetre = 1e-3;
// Instruments print rounded quaternions.
constexpr double kNormalisedWithin = 1e-3;

// The same quantity under two names, of which one at most may be given.
std::optional<std::vector<double>> Either(JsonFields& fields, const char* si, const char* other,
                                          size_t size, double factor) {
  if (fields.Has(si) && fields.Has(other)) {
    fields.AddFault(other, absl::StrCat("beside ", si), "one of the two");
    return fields.Numbers(other, size, factor);
  }
  auto values = fields.Numbers(other, size, factor);
  auto in_si = fields.Numbers(si, size);
  return in_si.has_value() ? in_si : values;
}

void Fill(const std::optional<std::vector<double>>& values,
          google::protobuf::RepeatedField<double>* out) {
  if (values.has_value()) out->Assign(values->begin(), values->end());
}

template <typename Mutable>
void FillVector(const std::optional<std::vector<double>>& values, Mutable mutable_vector) {
  if (!values.has_value()) return;
  v1::Vector3& vector = *mutable_vector();
  vector.set_x((*values)[0]);
  vector.set_y((*values)[1]);
  vector.set_z((*values)[2]);
}

void FillOrientation(JsonFields& fields, v1::Reading* reading) {
  const auto q = fields.Numbers("quaternion", 4);
  if (!q.has_value()) return;
  double length = 0;
  for (const double part : *q) length = std::hypot(length, part);
  if (!(std::abs(length - 1) <= kNormalisedWithin))
    return fields.AddFault("quaternion", absl::StrCat("length ", length),
                           "[x, y, z, w] of length 1");
  v1::Quaternion& out = *reading->mutable_orientation();
  out.set_x((*q)[0] / length);
  out.set_y((*q)[1] / length);
  out.set_z((*q)[2] / length);
  out.set_w((*q)[3] / length);
}

std::optional<double> Length(JsonFields& fields, const char* si, const char* mm) {
  const auto metres = fields.Number(si), millimetres = fields.Number(mm);
  if (metres.has_value() && millimetres.has_value())
    fields.AddFault(mm, absl::StrCat("beside ", si), "one of the two");
  if (metres.has_value()) return metres;
  return millimetres.has_value() ? std::optional(*millimetres * kMillimetre) : std::nullopt;
}

void FillDistance(JsonFields& fields, v1::Reading* reading) {
  if (const auto distance = Length(fields, "distance_m", "distance_mm"))
    reading->set_distance_m(*distance);
  if (const auto sd = Length(fields, "distance_sd_m", "distance_sd_mm"))
    reading->set_distance_sd_m(*sd);
}

void FillTexts(JsonFields& fields, v1::Reading* reading) {
  reading->set_placement(fields.Text("placement").value_or(""));
  reading->set_target(fields.Text("target").value_or(""));
  reading->set_group(fields.Text("group").value_or(""));
  reading->set_coordinates(fields.Text("coordinates").value_or(""));
  reading->set_anchor(fields.Text("anchor").value_or(""));
  reading->set_beam(fields.Text("beam").value_or(""));
  reading->set_feature(fields.Text("feature").value_or(""));
  for (std::string& value : fields.Texts("extra").value_or(std::vector<std::string>()))
    reading->add_extra_values(std::move(value));
}

void CheckClock(JsonFields& fields, absl::Time time, const ReadingJsonOptions& options) {
  const absl::Time now = absl::UnixEpoch() + absl::Seconds(options.now_s);
  if (options.largest_clock_difference_s <= 0) return;
  if (absl::AbsDuration(time - now) <= absl::Seconds(options.largest_clock_difference_s)) return;
  fields.AddFault(
      "time", absl::FormatTime(time, absl::UTCTimeZone()),
      absl::StrCat("within ", options.largest_clock_difference_s, " s of this PC's ",
                   absl::FormatTime(now, absl::UTCTimeZone()), "; one of the two clocks is wrong"));
}

void FillTime(JsonFields& fields, const Json& object, const ReadingJsonOptions& options,
              v1::Reading* reading) {
  const auto found = object.find("time");
  if (found != object.end() && found->is_number()) {
    const absl::Time time = absl::UnixEpoch() + absl::Seconds(fields.Number("time").value_or(0));
    CheckClock(fields, time, options);
    reading->set_time(absl::FormatTime(absl::RFC3339_full, time, absl::UTCTimeZone()));
    return;
  }
  const auto text = fields.Text("time");
  if (!text.has_value()) return;
  absl::Time time;
  std::string error;
  if (!absl::ParseTime(absl::RFC3339_full, *text, &time, &error))
    return fields.AddFault("time", absl::StrCat("'", *text, "'"),
                           "a time such as 2026-03-01T14:05:09.2+01:00");
  CheckClock(fields, time, options);
  reading->set_time(*text);
}

}  // namespace

v1::Reading ReadingFromJson(JsonFields& fields, const ReadingJsonOptions& options) {
  v1::Reading reading;
  Fill(Either(fields, "joints", "joints_deg", 0, kDegree), reading.mutable_joints_measured());
  Fill(Either(fields, "joints_commanded", "joints_commanded_deg", 0, kDegree),
       reading.mutable_joints_commanded());
  Fill(fields.Numbers("torques_nm", 0), reading.mutable_joint_torques_nm());
  FillVector(Either(fields, "position_m", "position_mm", 3, kMillimetre),
             [&] { return reading.mutable_position_m(); });
  FillVector(Either(fields, "position_sd_m", "position_sd_mm", 3, kMillimetre),
             [&] { return reading.mutable_position_sd_m(); });
  FillVector(fields.Numbers("axis", 3), [&] { return reading.mutable_axis(); });
  FillOrientation(fields, &reading);
  FillDistance(fields, &reading);
  if (const auto temperature = fields.Number("temperature_c"))
    reading.set_temperature_c(*temperature);
  FillTexts(fields, &reading);
  FillTime(fields, fields.object(), options, &reading);
  return reading;
}

}  // namespace truepose::agent
