#include "core/models/incremental_form.h"

namespace truepose {

Model ModifiedIncremental(const Robot& robot, ModelExtent extent) {
  Model model = BuildIncremental(robot, extent, {AxisErrors::kRotationsFirst, true});
  model.kind = "modified_incremental";
  model.convention =
      "modified_incremental/1: B = Rx(dalpha) Ry(dbeta) Tx(da) Ty(db), D = Rz|Tz(dq)";
  return model;
}

}  // namespace truepose
