/* libtruepose_compensation in plain C: corrected joints of a calibrated robot from one file,
 * without a server.
 *
 * Load a compensation table once; everything else allocates nothing, keeps no state and may be
 * called from any number of threads at once. Units are m and rad, arrays of joints are in the
 * controller's order. X_BF is where flange frame F stands in base frame B: p_B = R p_F + p, R row
 * by row.
 *
 * Nothing is corrected silently wrong: every call says by its outcome whether `q` may be commanded.
 */
#ifndef TRUEPOSE_COMPENSATION_C_H_
#define TRUEPOSE_COMPENSATION_C_H_

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define TRUEPOSE_API __attribute__((visibility("default")))
#else
#define TRUEPOSE_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

#define TRUEPOSE_MAX_JOINTS 12

/* Why a file was not loaded. */
typedef enum truepose_load_status {
  TRUEPOSE_LOAD_OK = 0,
  TRUEPOSE_LOAD_NOT_OPENED = 1, /* no such file, no permission, not a regular file */
  TRUEPOSE_LOAD_NO_MEMORY = 2,
  TRUEPOSE_LOAD_NOT_A_TABLE = 3,  /* the first bytes are another format's */
  TRUEPOSE_LOAD_NEWER_SCHEMA = 4, /* written by a later version */
  TRUEPOSE_LOAD_TRUNCATED = 5,
  TRUEPOSE_LOAD_TRAILING_BYTES = 6,
  TRUEPOSE_LOAD_DAMAGED = 7, /* the digest is not that of the bytes */
  TRUEPOSE_LOAD_INVALID_FIELD = 8,
  TRUEPOSE_LOAD_OTHER_ROBOT = 9,
  TRUEPOSE_LOAD_OTHER_NOMINAL = 10,
  TRUEPOSE_LOAD_OTHER_CALIBRATION = 11,
  TRUEPOSE_LOAD_INVALID_ARGUMENT = 12 /* a null pointer */
} truepose_load_status;

/* How a correction ended. Only joints of TRUEPOSE_OK are to be commanded. */
typedef enum truepose_outcome {
  TRUEPOSE_OK = 0,
  TRUEPOSE_NEAR_SINGULAR = 1,
  TRUEPOSE_BEYOND_LIMIT =
      2, /* the corrected joints are beyond the limit of truepose_correction.joint */
  TRUEPOSE_UNREACHABLE = 3,
  TRUEPOSE_OUTSIDE_DOMAIN = 4, /* of the table: of its axis truepose_correction.joint */
  TRUEPOSE_INVALID_ARGUMENT =
      5 /* a number that is not finite, no rotation, a null pointer, a measuring arm */
} truepose_outcome;

typedef struct truepose_compensation truepose_compensation;

/* What the file must be for. A null pointer asks for nothing. */
typedef struct truepose_expectation {
  const char* serial;                /* of the robot */
  const uint8_t* nominal_digest;     /* 32 bytes */
  const uint8_t* calibration_digest; /* 32 bytes */
} truepose_expectation;

/* What was found and what was expected; ends with a zero byte. */
typedef struct truepose_message {
  char text[256];
} truepose_message;

typedef struct truepose_pose {
  double R[9];
  double p[3];
} truepose_pose;

typedef struct truepose_correction {
  truepose_outcome outcome;
  int joint; /* from 0, see truepose_outcome; else -1 */
  int iterations;
  double position_error_m; /* left at q: by the table, or exactly by the identified chain */
  double rotation_error_rad;
  double smallest_singular_value; /* of the Jacobian; -1: not looked at */
  double q[TRUEPOSE_MAX_JOINTS];  /* of the controller */
} truepose_correction;

/* The texts live as long as the table. */
typedef struct truepose_table_info {
  uint32_t schema;
  const char* robot;
  const char* serial;
  const char* calibration;
  uint8_t calibration_digest[32];
  uint8_t nominal_digest[32];
  int64_t created_us; /* since 1970, UTC */
  int joints;
  int measuring; /* 1: joints are read, never commanded */
  double tolerance_position_m, tolerance_rotation_rad;
  uint32_t verification_points;
  double worst_position_m, worst_rotation_rad; /* found at that many points that are no nodes */
  double percentile_95_position_m, percentile_95_rotation_rad;
  double predicted_accuracy_95_m; /* of the tool, the table's error included; 0: not predicted */
  double near_singular_share;     /* of drawn targets of the domain */
  double smallest_singular_value; /* below it correction by the table is refused */
} truepose_table_info;

/* One coordinate u = sum of weight[j] q_chain[j] of the domain, q_chain = joint_scale q +
 * joint_offset. */
typedef struct truepose_axis {
  double weight[TRUEPOSE_MAX_JOINTS];
  double lower, upper; /* targets outside are refused */
  int nodes;           /* 1: the correction does not depend on u */
} truepose_axis;

/* Maps the file read-only, reads it through once and checks every byte and field. Replace the file
 * by renaming another onto its name, never by writing into it. expectation and message may be null.
 * *compensation is set only on TRUEPOSE_LOAD_OK; truepose_compensation_free ends it. */
TRUEPOSE_API truepose_load_status
truepose_compensation_load(const char* path, const truepose_expectation* expectation,
                           truepose_compensation** compensation, truepose_message* message);

/* The same from bytes in memory, of which a copy is kept. */
TRUEPOSE_API truepose_load_status truepose_compensation_load_bytes(
    const void* bytes, size_t size, const truepose_expectation* expectation,
    truepose_compensation** compensation, truepose_message* message);

/* Null is allowed. No other call may be at work on it. */
TRUEPOSE_API void truepose_compensation_free(truepose_compensation* compensation);

TRUEPOSE_API void truepose_compensation_info(const truepose_compensation* compensation,
                                             truepose_table_info* info);

/* axis from 0; returns 0, or -1 when there is no such axis. */
TRUEPOSE_API int truepose_compensation_axis(const truepose_compensation* compensation, int axis,
                                            truepose_axis* found);

/* By the table, in about a microsecond: joints at which the flange stands where the nominal one
 * would at q. q has `joints` numbers. The same outcome is returned and in the correction. */
TRUEPOSE_API truepose_outcome truepose_compensation_correct_joints(
    const truepose_compensation* compensation, const double* q, truepose_correction* correction);

/* The same without the table's nodes and domain: exact to 1e-10 m. */
TRUEPOSE_API truepose_outcome truepose_compensation_correct_joints_exactly(
    const truepose_compensation* compensation, const double* q, truepose_correction* correction);

/* Joints at which the flange stands at X_BF, in the configuration nearest to q_seed. Exact. */
TRUEPOSE_API truepose_outcome truepose_compensation_correct_pose(
    const truepose_compensation* compensation, const truepose_pose* X_BF, const double* q_seed,
    truepose_correction* correction);

/* Where the flange stands at joints q: as the controller believes, as it was identified, and as the
 * table has it (which asks for its domain). The pose is set only with TRUEPOSE_OK. */
TRUEPOSE_API truepose_outcome truepose_compensation_nominal_flange(
    const truepose_compensation* compensation, const double* q, truepose_pose* X_BF);
TRUEPOSE_API truepose_outcome truepose_compensation_identified_flange(
    const truepose_compensation* compensation, const double* q, truepose_pose* X_BF);
TRUEPOSE_API truepose_outcome truepose_compensation_table_flange(
    const truepose_compensation* compensation, const double* q, truepose_pose* X_BF);

/* "ok", "near_singular", ... and "ok", "damaged", ...; never null. */
TRUEPOSE_API const char* truepose_outcome_text(truepose_outcome outcome);
TRUEPOSE_API const char* truepose_load_status_text(truepose_load_status status);

/* Of the library: "0.1.0". */
TRUEPOSE_API const char* truepose_compensation_version(void);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* TRUEPOSE_COMPENSATION_C_H_ */
