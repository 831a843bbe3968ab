#include "convert/accuracy_map.h"

#include "convert/accuracy_sources.h"
#include "convert/arm.h"
#include "convert/box_domain.h"
#include "convert/prepared_calibration.h"
#include "convert/report.h"
#include "convert/table_spec.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/compensation/accuracy_map.h"

namespace truepose::convert {
namespace {

constexpr int kAlongX = 13, kAlongY = 13, kAlongZ = 3;

v1::AccuracyMapSpec Completed(v1::AccuracyMapSpec spec) {
  v1::CompensationTableSpec table;
  *table.mutable_box() = spec.box();
  *spec.mutable_box() = CompleteTableSpec(table).box();
  if (spec.points_x() == 0) spec.set_points_x(kAlongX);
  if (spec.points_y() == 0) spec.set_points_y(kAlongY);
  if (spec.points_z() == 0) spec.set_points_z(kAlongZ);
  return spec;
}

absl::Status CheckBox(const v1::Nominal& nominal, const v1::BoxDomain& box) {
  v1::CompensationTableSpec table;
  *table.mutable_box() = box;
  return ValidateTableSpec(nominal, table);
}

absl::StatusOr<AccuracyMapSpec> SpecFrom(const v1::Nominal& nominal,
                                         const v1::AccuracyMapSpec& message) {
  AccuracyMapSpec spec;
  TRUEPOSE_ASSIGN_OR_RETURN(spec.box, BoxFrom(nominal, message.box()));
  spec.points = {message.points_x(), message.points_y(), message.points_z()};
  return spec;
}

void FillPoint(const AccuracyPoint& point, v1::AccuracyMapPoint* message) {
  message->set_x_m(point.p_BT.x());
  message->set_y_m(point.p_BT.y());
  message->set_z_m(point.p_BT.z());
  message->set_reached(point.reached);
  if (!point.reached) return;
  for (double q : point.q) message->add_joints(q);
  message->set_rms_mm(point.accuracy.rms_m * kMmPerM);
  message->set_position_95_mm(point.accuracy.position_95_m * kMmPerM);
  message->set_parameters_mm(point.accuracy.parameters_m * kMmPerM);
  message->set_unexplained_mm(point.accuracy.unexplained_m * kMmPerM);
  message->set_repeatability_mm(point.accuracy.repeatability_m * kMmPerM);
}

v1::AccuracyMap ToProto(const AccuracyMap& map) {
  v1::AccuracyMap message;
  for (const AccuracyPoint& point : map.points) FillPoint(point, message.add_points());
  message.set_reached(map.reached);
  message.set_rms_mm(map.rms_m * kMmPerM);
  message.set_position_95_mm(map.position_95_m * kMmPerM);
  message.set_best_95_mm(map.points[map.best].accuracy.position_95_m * kMmPerM);
  message.set_worst_95_mm(map.points[map.worst].accuracy.position_95_m * kMmPerM);
  return message;
}

absl::Status NoCovariance() {
  FaultList faults;
  faults.Add("calibration.covariance", "none",
             "a calibration with its covariance, as a run stores it");
  return faults.ToStatus(absl::StatusCode::kFailedPrecondition);
}

}  // namespace

absl::StatusOr<v1::AccuracyMap> RunAccuracyMap(const v1::Nominal& nominal,
                                               const v1::Calibration& calibration,
                                               const v1::AccuracyMapSpec& spec,
                                               const RunHooks& hooks) {
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedArm arm, CalibratedArmFrom(nominal, calibration));
  TRUEPOSE_RETURN_IF_ERROR(CheckBox(nominal, spec.box()));
  const v1::AccuracyMapSpec completed = Completed(spec);
  TRUEPOSE_ASSIGN_OR_RETURN(const AccuracyMapSpec of_core, SpecFrom(nominal, completed));
  const auto sources = AccuracySourcesFrom(arm.calibrated, calibration);
  if (!sources) return NoCovariance();
  TRUEPOSE_ASSIGN_OR_RETURN(const AccuracyMap map,
                            MapAccuracy(arm.arm, *sources, of_core, CoreHooks(hooks)));
  v1::AccuracyMap message = ToProto(map);
  message.set_calibration(calibration.name());
  message.set_calibration_digest(calibration.digest());
  *message.mutable_spec() = completed;
  return message;
}

}  // namespace truepose::convert
