#include "convert/table_verify.h"

#include "absl/strings/str_cat.h"
#include "convert/arm.h"
#include "convert/run.h"
#include "convert/table_header.h"
#include "convert/table_spec.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "core/compensation/verify_table.h"

namespace truepose::convert {
namespace {

void CheckSame(const std::string& found, const std::string& expected, const char* what,
               FaultList* faults) {
  if (found != expected)
    faults->Add("table", absl::StrCat(what, " ", found),
                absl::StrCat("that of ", what, " ", expected));
}

absl::Status Check(const compensation::Table& table, const v1::Nominal& nominal,
                   const v1::Calibration& calibration, const TableVerificationOptions& options) {
  const v1::CompensationTableHeader header = HeaderToProto(table);
  FaultList faults;
  CheckSame(header.nominal_digest(), NominalDigest(nominal), "nominal", &faults);
  CheckSame(header.calibration_digest(), calibration.digest(), "calibration", &faults);
  if (options.points < kFewestVerificationPoints || options.points > kMostVerificationPoints)
    faults.Add("points", absl::StrCat(options.points),
               absl::StrCat(kFewestVerificationPoints, " to ", kMostVerificationPoints));
  return faults.ToStatus();
}

v1::TableVerification ToProto(const Verification& verification,
                              const compensation::TableHeader& header) {
  v1::TableVerification message;
  message.set_points(verification.points);
  message.set_drawn(verification.drawn);
  message.set_near_singular(verification.near_singular);
  message.set_beyond_limit(verification.beyond_limit);
  message.set_outside_domain(verification.outside_domain);
  v1::CompensationTableError* error = message.mutable_error();
  error->set_worst_position_m(verification.worst.position_m);
  error->set_worst_rotation_rad(verification.worst.rotation_rad);
  error->set_position_95_m(verification.percentile_95.position_m);
  error->set_rotation_95_rad(verification.percentile_95.rotation_rad);
  message.set_within_stated(verification.worst.position_m <= header.worst.position_m &&
                            verification.worst.rotation_rad <= header.worst.rotation_rad);
  return message;
}

}  // namespace

absl::StatusOr<v1::TableVerification> RunTableVerification(
    const compensation::Table& table, const v1::Nominal& nominal,
    const v1::Calibration& calibration, const TableVerificationOptions& options) {
  TRUEPOSE_ASSIGN_OR_RETURN(const CalibratedArm arm, CalibratedArmFrom(nominal, calibration));
  TRUEPOSE_RETURN_IF_ERROR(Check(table, nominal, calibration, options));
  TRUEPOSE_ASSIGN_OR_RETURN(const Verification verification,
                            VerifyTable(table, arm.arm, {options.points, options.seed, 0, 1}, {}));
  return ToProto(verification, table.header);
}

}  // namespace truepose::convert
