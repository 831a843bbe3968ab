#include "client/agent/sources/configured.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "absl/strings/ascii.h"
#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "client/agent/sources/csv_source.h"
#include "client/agent/sources/folder_source.h"
#include "client/agent/sources/json_source.h"
#include "core/base/status_macros.h"
#include "formats/rotation.h"

namespace truepose::agent {
namespace {

constexpr double kLongest_s = 1e6;

// The settings, key by key; what is wrong goes into the list.
class Settings {
 public:
  Settings(const SourceSettings& settings, FaultList& faults)
      : settings_(settings), faults_(faults) {}

  std::optional<std::string> Text(const char* key) {
    asked_.insert(key);
    const auto value = settings_.values.find(key);
    if (value == settings_.values.end()) return std::nullopt;
    return value->second;
  }

  std::string Required(const char* key) {
    const std::string text = Text(key).value_or("");
    if (text.empty()) Fault(key, "nothing", "a value");
    return text;
  }

  std::optional<double> Number(const char* key, double most) {
    const std::optional<std::string> text = Text(key);
    if (!text.has_value()) return std::nullopt;
    double value;
    if (absl::SimpleAtod(*text, &value) && value >= 0 && value <= most) return value;
    Fault(key, absl::StrCat("'", *text, "'"), absl::StrCat("a number from 0 to ", most));
    return std::nullopt;
  }

  std::optional<std::chrono::milliseconds> Time(const char* key, double unit_s) {
    const std::optional<double> value = Number(key, kLongest_s / unit_s);
    if (!value.has_value()) return std::nullopt;
    return std::chrono::milliseconds(std::llround(*value * unit_s * 1e3));
  }

  void Fault(const char* key, std::string found, std::string expected) {
    faults_.Add(key, std::move(found), std::move(expected));
  }

  void RefuseOthers() {
    for (const auto& [key, value] : settings_.values) {
      if (asked_.contains(key)) continue;
      faults_.Add(key, absl::StrCat("'", value, "'"),
                  absl::StrCat("one of ", absl::StrJoin(asked_, ", ")));
    }
  }

  const SourceSettings& all() const { return settings_; }

 private:
  const SourceSettings& settings_;
  FaultList& faults_;
  std::set<std::string> asked_;
};

v1::SessionPurpose PurposeOf(Settings& settings) {
  const std::string purpose = settings.Text("purpose").value_or("calibration");
  if (purpose == "check") return v1::CHECK;
  if (purpose != "calibration")
    settings.Fault("purpose", absl::StrCat("'", purpose, "'"), "calibration or check");
  return v1::CALIBRATION;
}

v1::Session ContentOf(Settings& settings) {
  v1::Session content;
  content.set_robot(settings.all().robot);
  content.set_purpose(PurposeOf(settings));
  content.set_instrument(settings.Text("instrument").value_or(""));
  content.set_fixture(settings.Text("fixture").value_or(""));
  content.set_operator_(settings.Text("operator").value_or(""));
  content.set_display_name(settings.Text("display_name").value_or(""));
  content.set_placement(settings.Text("placement").value_or(""));
  return content;
}

std::optional<SettleOptions> SettleOf(Settings& settings) {
  const auto still = settings.Time("still_s", 1.0);
  const auto tolerance = settings.Number("still_tolerance", 1.0);
  if (!still.has_value()) {
    if (tolerance.has_value())
      settings.Fault("still_tolerance", "a tolerance without a time", "still_s with it");
    return std::nullopt;
  }
  SettleOptions options;
  options.still = *still;
  options.tolerance = tolerance.value_or(options.tolerance);
  return options;
}

v1::Nominal JointsOf(Settings& settings) {
  v1::Nominal nominal;
  for (int i = 0; i < settings.all().joints; ++i) nominal.add_joints()->set_type(v1::REVOLUTE);
  for (const auto part : absl::StrSplit(settings.Text("sliding").value_or(""), ',')) {
    const std::string text(absl::StripAsciiWhitespace(part));
    int joint = 0;
    if (text.empty()) continue;
    if (absl::SimpleAtoi(text, &joint) && joint >= 1 && joint <= nominal.joints_size()) {
      nominal.mutable_joints(joint - 1)->set_type(v1::PRISMATIC);
    } else {
      settings.Fault("sliding", absl::StrCat("'", text, "'"),
                     absl::StrCat("joints from 1 to ", nominal.joints_size()));
    }
  }
  return nominal;
}

CsvOptions CsvOf(Settings& settings) {
  CsvOptions csv;
  csv.content = ContentOf(settings);
  csv.nominal = JointsOf(settings);
  csv.settle = SettleOf(settings);
  csv.euler = settings.Text("euler").value_or("");
  if (csv.euler.empty()) return csv;
  const auto convention = formats::ParseEulerConvention(csv.euler);
  for (const truepose::Fault& fault : FaultsOf(convention.status()))
    settings.Fault("euler", fault.found, fault.expected);
  return csv;
}

std::unique_ptr<Source> MakeCsv(Settings& settings, const FaultReport& report) {
  CsvSourceOptions options;
  options.path = settings.Required("path");
  options.csv = CsvOf(settings);
  options.poll = settings.Time("poll_ms", 1e-3).value_or(options.poll);
  options.seal_after = settings.Time("seal_after_s", 1.0).value_or(options.seal_after);
  return std::make_unique<CsvSource>(std::move(options), report);
}

std::unique_ptr<Source> MakeFolder(Settings& settings, const FaultReport& report) {
  FolderSourceOptions options;
  options.path = settings.Required("path");
  options.csv = CsvOf(settings);
  options.poll = settings.Time("poll_ms", 1e-3).value_or(options.poll);
  return std::make_unique<FolderSource>(std::move(options), report);
}

std::unique_ptr<Source> MakeJson(Settings& settings, const FaultReport& report) {
  JsonSourceOptions options;
  options.content = ContentOf(settings);
  options.settle = SettleOf(settings);
  return std::make_unique<JsonSource>(std::move(options), report);
}

struct Kind {
  const char* name;
  std::unique_ptr<Source> (*make)(Settings&, const FaultReport&);
};
constexpr Kind kKinds[] = {{"csv", MakeCsv}, {"folder", MakeFolder}, {"stdin", MakeJson}};

}  // namespace

std::vector<std::string> SourceKinds() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.push_back(kind.name);
  return names;
}

absl::StatusOr<std::unique_ptr<Source>> MakeSource(const SourceSettings& settings,
                                                   const FaultReport& report) {
  const Kind* kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                  [&](const Kind& known) { return known.name == settings.kind; });
  if (kind == std::end(kKinds)) {
    return FaultStatus("kind", absl::StrCat("'", settings.kind, "'"),
                       absl::StrCat("one of ", absl::StrJoin(SourceKinds(), ", ")));
  }
  FaultList faults;
  Settings keys(settings, faults);
  std::unique_ptr<Source> source = kind->make(keys, report);
  keys.RefuseOthers();
  TRUEPOSE_RETURN_IF_ERROR(faults.ToStatus());
  return source;
}

}  // namespace truepose::agent
