// Which recalibration requests somebody still has to do something for.
#pragma once

#include "truepose/v1/recalibration.pb.h"

namespace truepose::store {

inline bool IsOpen(v1::RecalibrationState state) {
  return state == v1::REQUEST_PENDING || state == v1::REQUEST_ACKNOWLEDGED ||
         state == v1::REQUEST_MEASURING || state == v1::REQUEST_CALIBRATING;
}

}  // namespace truepose::store
