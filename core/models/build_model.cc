#include "core/models/build_model.h"

#include <array>

#include "absl/strings/str_cat.h"
#include "absl/strings/str_join.h"
#include "core/base/fault.h"

namespace truepose {
namespace {

struct Kind {
  const char* name;
  Model (*build)(const Robot& robot, ModelExtent extent);
};

constexpr std::array<Kind, 4> kKinds = {{{"modified_incremental", ModifiedIncremental},
                                         {"incremental", Incremental},
                                         {"zhuang_roth", ZhuangRoth},
                                         {"extended_dh", ExtendedDh}}};

constexpr char kField[] = "options.model";

}  // namespace

const std::vector<std::string>& ModelKinds() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Kind& kind : kKinds) all.emplace_back(kind.name);
    return all;
  }();
  return names;
}

absl::StatusOr<Model> BuildModel(const std::string& kind, const Robot& robot, ModelExtent extent) {
  for (const Kind& known : kKinds) {
    if (kind != known.name) continue;
    Model model = known.build(robot, extent);
    if (model.parameters.size() > 0) return model;
    return FaultStatus(kField, absl::StrCat(kind, " of a robot with one joint"),
                       "modified_incremental or extended_dh: this model has no parameter between "
                       "base and flange of such a robot");
  }
  return FaultStatus(kField, kind, absl::StrCat("one of ", absl::StrJoin(ModelKinds(), ", ")));
}

}  // namespace truepose
