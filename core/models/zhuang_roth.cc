#include "core/models/incremental_form.h"

namespace truepose {

Model ZhuangRoth(const Robot& robot, ModelExtent extent) {
  Model model = BuildIncremental(robot, extent, {AxisErrors::kTilt, false});
  model.kind = "zhuang_roth";
  model.convention = "zhuang_roth/1: B = Tx(da) Ty(db) R(z -> (dthetax, dthetay, .)) of Eq. 23";
  return model;
}

}  // namespace truepose
