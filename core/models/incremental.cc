#include "core/models/incremental_form.h"

namespace truepose {

Model Incremental(const Robot& robot, ModelExtent extent) {
  Model model = BuildIncremental(robot, extent, {AxisErrors::kRotationsFirst, false});
  model.kind = "incremental";
  model.convention = "incremental/1: B = Rx(dalpha) Ry(dbeta) Tx(da) Ty(db)";
  return model;
}

}  // namespace truepose
