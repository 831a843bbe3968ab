// The plain C interface over the runtime: arguments are checked for null here, everything else
// below.
#include <algorithm>
#include <cstring>
#include <new>

#include "compensation/correct_by_table.h"
#include "compensation/table_file.h"
#include "compensation/valid.h"
#include "truepose/compensation_c.h"

struct truepose_compensation {
  truepose::compensation::TableFile file;
};

namespace {

namespace runtime = truepose::compensation;
using truepose::Pose;

static_assert(TRUEPOSE_MAX_JOINTS == runtime::kMaxJoints);
static_assert(static_cast<int>(runtime::TableFault::kOtherCalibration) ==
              TRUEPOSE_LOAD_OTHER_CALIBRATION);
static_assert(static_cast<int>(runtime::TableFault::kInvalidField) == TRUEPOSE_LOAD_INVALID_FIELD);
static_assert(static_cast<int>(runtime::Outcome::kNearSingular) == TRUEPOSE_NEAR_SINGULAR);
static_assert(static_cast<int>(runtime::Outcome::kUnreachable) == TRUEPOSE_UNREACHABLE);
static_assert(static_cast<int>(runtime::Outcome::kInvalidArgument) == TRUEPOSE_INVALID_ARGUMENT);

std::optional<runtime::Digest> DigestOf(const std::uint8_t* bytes) {
  if (bytes == nullptr) return std::nullopt;
  runtime::Digest digest;
  std::copy_n(bytes, digest.size(), digest.begin());
  return digest;
}

runtime::TableExpectation ExpectationOf(const truepose_expectation* expected) {
  runtime::TableExpectation expectation;
  if (expected == nullptr) return expectation;
  if (expected->serial != nullptr) expectation.serial = expected->serial;
  expectation.nominal_digest = DigestOf(expected->nominal_digest);
  expectation.calibration_digest = DigestOf(expected->calibration_digest);
  return expectation;
}

truepose_load_status Reported(const runtime::TableReport& report, truepose_message* message) {
  static_assert(sizeof(message->text) == sizeof(report.message));
  if (message != nullptr) std::memcpy(message->text, report.message.data(), report.message.size());
  return static_cast<truepose_load_status>(report.fault);
}

// Loads by `load(TableFile*)` into a new object, which is given away only when it was right.
template <class Load>
truepose_load_status LoadNew(truepose_compensation** compensation, truepose_message* message,
                             Load load) {
  auto* made = new (std::nothrow) truepose_compensation;
  if (made == nullptr) {
    return Reported(runtime::Refused(runtime::TableFault::kNoMemory, "no memory for a table"),
                    message);
  }
  const runtime::TableReport report = load(&made->file);
  if (report.ok()) {
    *compensation = made;
  } else {
    delete made;
  }
  return Reported(report, message);
}

truepose_load_status NullArgument(truepose_message* message) {
  if (message != nullptr) std::strcpy(message->text, "found a null pointer");
  return TRUEPOSE_LOAD_INVALID_ARGUMENT;
}

truepose_outcome Filled(const runtime::Correction& from, truepose_correction* to) {
  to->outcome = static_cast<truepose_outcome>(from.outcome);
  to->joint = from.joint;
  to->iterations = from.iterations;
  to->position_error_m = from.position_error_m;
  to->rotation_error_rad = from.rotation_error_rad;
  to->smallest_singular_value = from.smallest_singular_value;
  std::copy(from.q.begin(), from.q.end(), to->q);
  return to->outcome;
}

truepose_outcome Invalid(truepose_correction* correction) {
  return correction == nullptr ? TRUEPOSE_INVALID_ARGUMENT
                               : Filled(runtime::Correction(), correction);
}

Pose PoseOf(const truepose_pose& from) {
  Pose X;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) X.R(i, j) = from.R[3 * i + j];
    X.p(i) = from.p[i];
  }
  return X;
}

truepose_outcome Given(const Pose& X, truepose_pose* to) {
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) to->R[3 * i + j] = X.R(i, j);
    to->p[i] = X.p(i);
  }
  return TRUEPOSE_OK;
}

bool AreJoints(const truepose_compensation* compensation, const double* q) {
  return compensation != nullptr && q != nullptr &&
         runtime::AreFinite(q, compensation->file.table().header.joints);
}

}  // namespace

extern "C" {

truepose_load_status truepose_compensation_load(const char* path,
                                                const truepose_expectation* expectation,
                                                truepose_compensation** compensation,
                                                truepose_message* message) {
  if (path == nullptr || compensation == nullptr) return NullArgument(message);
  return LoadNew(compensation, message, [&](runtime::TableFile* file) {
    return runtime::TableFile::Map(path, ExpectationOf(expectation), file);
  });
}

truepose_load_status truepose_compensation_load_bytes(const void* bytes, size_t size,
                                                      const truepose_expectation* expectation,
                                                      truepose_compensation** compensation,
                                                      truepose_message* message) {
  if (bytes == nullptr || compensation == nullptr) return NullArgument(message);
  return LoadNew(compensation, message, [&](runtime::TableFile* file) {
    return runtime::TableFile::Copy({static_cast<const std::byte*>(bytes), size},
                                    ExpectationOf(expectation), file);
  });
}

void truepose_compensation_free(truepose_compensation* compensation) { delete compensation; }

void truepose_compensation_info(const truepose_compensation* compensation,
                                truepose_table_info* info) {
  if (info == nullptr) return;
  *info = {};
  if (compensation == nullptr) return;
  const runtime::TableHeader& header = compensation->file.table().header;
  info->schema = header.schema;
  info->robot = header.robot.c_str();
  info->serial = header.serial.c_str();
  info->calibration = header.calibration.c_str();
  std::copy(header.calibration_digest.begin(), header.calibration_digest.end(),
            info->calibration_digest);
  std::copy(header.nominal_digest.begin(), header.nominal_digest.end(), info->nominal_digest);
  info->created_us = header.created_us;
  info->joints = header.joints;
  info->measuring = compensation->file.table().arm.measuring ? 1 : 0;
  info->tolerance_position_m = header.tolerance.position_m;
  info->tolerance_rotation_rad = header.tolerance.rotation_rad;
  info->verification_points = header.verification_points;
  info->worst_position_m = header.worst.position_m;
  info->worst_rotation_rad = header.worst.rotation_rad;
  info->percentile_95_position_m = header.percentile_95.position_m;
  info->percentile_95_rotation_rad = header.percentile_95.rotation_rad;
  info->predicted_accuracy_95_m = header.predicted_accuracy_95_m;
  info->near_singular_share = header.near_singular_share;
  info->smallest_singular_value = header.smallest_singular_value;
}

int truepose_compensation_axis(const truepose_compensation* compensation, int axis,
                               truepose_axis* found) {
  if (compensation == nullptr || found == nullptr || axis < 0 ||
      axis >= compensation->file.table().header.joints) {
    return -1;
  }
  const runtime::TableAxis& from = compensation->file.table().axis[axis];
  std::copy(from.weight.begin(), from.weight.end(), found->weight);
  found->lower = from.lower;
  found->upper = from.upper;
  found->nodes = from.nodes;
  return 0;
}

truepose_outcome truepose_compensation_correct_joints(const truepose_compensation* compensation,
                                                      const double* q,
                                                      truepose_correction* correction) {
  if (compensation == nullptr || q == nullptr || correction == nullptr) return Invalid(correction);
  return Filled(CorrectByTable(compensation->file.table(), q), correction);
}

truepose_outcome truepose_compensation_correct_joints_exactly(
    const truepose_compensation* compensation, const double* q, truepose_correction* correction) {
  if (compensation == nullptr || q == nullptr || correction == nullptr) return Invalid(correction);
  return Filled(CorrectJoints(compensation->file.table().arm, q, runtime::ExactOptions()),
                correction);
}

truepose_outcome truepose_compensation_correct_pose(const truepose_compensation* compensation,
                                                    const truepose_pose* X_BF, const double* q_seed,
                                                    truepose_correction* correction) {
  if (compensation == nullptr || X_BF == nullptr || q_seed == nullptr || correction == nullptr)
    return Invalid(correction);
  return Filled(
      CorrectPose(compensation->file.table().arm, PoseOf(*X_BF), q_seed, runtime::ExactOptions()),
      correction);
}

truepose_outcome truepose_compensation_nominal_flange(const truepose_compensation* compensation,
                                                      const double* q, truepose_pose* X_BF) {
  if (!AreJoints(compensation, q) || X_BF == nullptr) return TRUEPOSE_INVALID_ARGUMENT;
  return Given(NominalFlange(compensation->file.table().arm, q), X_BF);
}

truepose_outcome truepose_compensation_identified_flange(const truepose_compensation* compensation,
                                                         const double* q, truepose_pose* X_BF) {
  if (!AreJoints(compensation, q) || X_BF == nullptr) return TRUEPOSE_INVALID_ARGUMENT;
  return Given(IdentifiedFlange(compensation->file.table().arm, q), X_BF);
}

truepose_outcome truepose_compensation_table_flange(const truepose_compensation* compensation,
                                                    const double* q, truepose_pose* X_BF) {
  if (!AreJoints(compensation, q) || X_BF == nullptr) return TRUEPOSE_INVALID_ARGUMENT;
  const runtime::Tip tip =
      TipByTable(compensation->file.table(), q, Pose(), Eigen::Vector3d::UnitZ());
  if (tip.outcome != runtime::Outcome::kOk) return static_cast<truepose_outcome>(tip.outcome);
  return Given(tip.X_BT, X_BF);
}

const char* truepose_outcome_text(truepose_outcome outcome) {
  return Name(static_cast<runtime::Outcome>(outcome));
}

const char* truepose_load_status_text(truepose_load_status status) {
  if (status == TRUEPOSE_LOAD_INVALID_ARGUMENT) return "invalid argument";
  return Name(static_cast<runtime::TableFault>(status));
}

const char* truepose_compensation_version(void) { return TRUEPOSE_VERSION; }

}  // extern "C"
