// One row of a session as what the core calls readings, before frames have numbers.
#pragma once

#include <string>
#include <vector>

#include "convert/fixture.h"
#include "core/measurement/reading.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::convert {

// Kind, measured values, stated uncertainty and `contact` of `reading` are set; its joints,
// conditions and indices are not.
struct Observation {
  Reading reading;
  std::string point;   // of several on one target: "p1"; "" the target itself
  std::string anchor;  // the unknown point that a distance is from; "" none
  std::string beam;    // distances with the same unknown constant; "" none
};

// What a row tells of the tool under `observe`:
//   a feature           contact at its place, by its kind; what else was measured of the pose is
//                       then not taken
//   position ...        pose, point and axis, point, or single coordinates
//   points              a point each
//   distance            to a feature's place, else to an unknown point, which is then the origin of
//                       a frame M of its own
// POSE, POINT and POINT_AXIS take what has at least that, and of it that alone; coordinates, planes
// and distances are taken only when `observe` is unspecified.
// @param feature the fixture's feature that the row names, nullptr for none.
std::vector<Observation> ObservationsOf(const v1::Reading& row, const FeaturePlace* feature,
                                        const FeaturePlaces& places, v1::Observe observe);

}  // namespace truepose::convert
