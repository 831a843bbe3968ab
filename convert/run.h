// Proto messages in, core's work, proto messages out: what a server's job, an RPC and `--local` all
// call, so that every way gives the same bits. The only layer where proto meets core.
//
// Every function is pure: it reads its arguments and returns a message, touches no clock, file or
// global, and leaves nothing behind on failure. Faults of the input come all at once
// (core/base/fault.h) with the field paths of the messages, such as
// `sessions[0].readings[17].joints_measured[3]`.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "google/protobuf/repeated_field.h"
#include "truepose/v1/calibration.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/services.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::convert {

struct RunHooks {
  // Called from the running thread, at most once an iteration; must not block.
  std::function<void(const v1::JobProgress&)> on_progress;
  // Asked once an iteration; true ends the run with kCancelled.
  std::function<bool()> is_cancelled;
};

// Identifies the parameters of one robot from one or more sessions.
// @returns a Calibration with internal_parameters, covariance, report, residuals, digest,
// nominal_revision and
//   sessions set; name, job, create_time and provenance are the caller's.
//   kInvalidArgument with faults for input that can't be used; kFailedPrecondition with faults when
//   the readings do not determine base and tool, or with options.require_complete when any
//   direction is dependent; kCancelled.
absl::StatusOr<v1::Calibration> RunCalibration(const v1::CalibrationInput& input,
                                               const RunHooks& hooks = {});

// What RunCalibration would identify, without solving for it: counts by formula and rank, the names
// of base, tool and internal parameters that the calibration rows determine, the others with a
// sentence each, and the number of usable readings, calibration and control together. A run may
// drop more and add effects that it chooses (core/calibrate/preview.h). With joints = both it is
// that of the measured ones. @returns the errors of RunCalibration that come before it solves.
absl::StatusOr<v1::JobPreview> RunPreview(const v1::CalibrationInput& input,
                                          const RunHooks& hooks = {});

// Applies a calibration to another session: base and tool are fitted on that session's own rows,
// internal parameters are nominal ("before") and identified ("after").
absl::StatusOr<v1::Evaluation> RunEvaluation(const v1::Nominal& nominal,
                                             const v1::Calibration& calibration,
                                             const v1::SessionInput& session, v1::Observe observe);

// Corrects joint or pose targets exactly (Newton on the identified internal chain, from B to F).
// A target that can't be corrected carries its fault; the others are corrected. Of a measuring
// robot the joints are those that were read, and the answer is the pose X_BT of the tip where it
// really is, without joints.
// @returns kFailedPrecondition for a calibration whose verdict is do_not_apply; kInvalidArgument
// with faults, also for compliance from measured torques without masses (torques.h).
absl::StatusOr<v1::CompensateResponse> RunCompensation(const v1::Nominal& nominal,
                                                       const v1::Calibration& calibration,
                                                       const v1::CompensateRequest& request);

// A model of a robot without data: candidates, which of them full poses of one tool at one
// placement identify at any poses, counts by formula and rank, redundancies with a sentence each
// ("dh2 = dh3: dropped dh3").
// @param kind as CalibrationOptions.model. @returns kInvalidArgument with faults, `options.model`
// for an unknown kind.
absl::StatusOr<v1::ModelDescription> RunModelDescription(const v1::Nominal& nominal,
                                                         const std::string& kind);

// Whether `options.calibrate` names what the robot's model of `options` has, with any effects.
// @returns kInvalidArgument with a fault of `options.calibrate` a name.
absl::Status CheckCalibratedNames(const v1::Nominal& nominal,
                                  const v1::CalibrationOptions& options);

// The same calibration in another model: predictions of base, robot and tool stay within 1e-9 m and
// rad, and so does their covariance, which goes through the derivative of the conversion
// (core/conversion/conversion_jacobian.h). Where the readings left directions at nominal, more
// parameters may carry the covariance than its rank; a warning says so. Name, job and release state
// are dropped, digest and options.model are new.
// @returns kInvalidArgument with faults for an unknown model or a calibration of another robot;
//   kFailedPrecondition with a fault `joints[i]` where the other model is singular.
absl::StatusOr<v1::Calibration> RunConversion(const v1::Nominal& nominal,
                                              const v1::Calibration& calibration,
                                              const std::string& model);

// The figures from which a session is made of a robot. Standard deviations of one draw per
// parameter.
struct SimulationOptions {
  int poses = 100;
  unsigned long long seed = 1;
  double length_error_sd_m = 0.0005;      // of each internal length parameter
  double angle_error_sd_rad = 0.0005;     // of each internal angle parameter
  double position_noise_sd_m = 0.00005;   // per axis
  double rotation_noise_sd_rad = 0.0001;  // per axis
  double joint_noise_sd = 0.0;            // rad or m, on the readings
  double encoder_resolution = 0.0;        // rad or m; readings are rounded to it, 0 = not at all
  double joint_range_rad =
      1.5;  // draws joints in +- this around the middle of the limits, within the limits
  double prismatic_range_m = 0.3;  // same for prismatic joints
};

struct Simulation {
  v1::SessionInput session;
  std::vector<v1::InternalParameter> truth;  // the internal errors that were drawn, all candidates
  std::string convention;  // what gives their names a meaning, as in a CalibrationReport
  v1::Pose X_MB, X_FT;
};

absl::StatusOr<Simulation> RunSimulation(const v1::Nominal& nominal,
                                         const SimulationOptions& options);

// What a calibration knew of the internal parameters, as the prior of another one.
v1::PriorCalibration PriorOf(const v1::Calibration& calibration);

// The measuring robot of the chapter's Sec. 11 (Eq. 37 as corrected in docs/models.md).
v1::Nominal MeasuringRobot();

// Every fault of a robot's content: joint count, types, limits, map, parallel consecutive prismatic
// joints, tools. Field paths of v1::Nominal, such as `joints[2].lower`,
// `geometry.standard_dh.rows`.
absl::Status ValidateNominal(const v1::Nominal& nominal);

// Every fault of readings for that robot: wrong number of joints, values that are not finite, a
// quaternion or axis that is not a unit vector (1e-6), rows that do not count from `first_row`
// without gaps.
absl::Status ValidateReadings(const v1::Nominal& nominal, const std::vector<v1::Reading>& readings,
                              int first_row);
// The same for a robot with that many joints. Readings without a fault cost no memory, so that an
// upload can be checked as it comes. Without `first_row` the rows may be anything.
absl::Status ValidateReadings(int joints,
                              const google::protobuf::RepeatedPtrField<v1::Reading>& readings,
                              std::optional<int> first_row);

// One warning a joint that exceeds its limits: its name, the limit, the rows.
std::vector<std::string> LimitWarnings(const v1::Nominal& nominal,
                                       const std::vector<v1::Reading>& readings);

// Faults of the options alone, without any data: an unknown model, an unreadable split and so on.
absl::Status ValidateOptions(const v1::CalibrationOptions& options);

// SHA-256 in lower-case hex over documented text lines (docs/formats.md), never over protobuf
// bytes.
std::string NominalDigest(const v1::Nominal& nominal);
std::string ReadingsDigest(const std::vector<v1::Reading>& readings);
// Nominal digest, session digests in order, and options of a job.
std::string JobInputDigest(const std::string& nominal_digest,
                           const std::vector<std::string>& session_digests,
                           const v1::CalibrationOptions& options);

}  // namespace truepose::convert
