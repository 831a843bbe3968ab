#include "convert/table_build.h"

#include <cstring>
#include <utility>
#include <vector>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "compensation/encode_table.h"
#include "convert/accuracy_sources.h"
#include "convert/arm.h"
#include "convert/box_domain.h"
#include "convert/prepared_calibration.h"
#include "convert/table_header.h"
#include "convert/table_spec.h"
#include "core/base/fault.h"
#include "core/base/random.h"
#include "core/base/status_macros.h"
#include "core/compensation/build_table.h"
#include "core/compensation/table_error.h"

namespace truepose::convert {
namespace {

constexpr int kAccuracyPoints = 500;  // the mean over these is that of the domain to some per cent

// All that is made of the messages.
struct Prepared {
  CalibratedArm arm;
  TableSpec spec;
};

absl::StatusOr<Prepared> PreparedFrom(const v1::CompensationTableInput& input) {
  TRUEPOSE_ASSIGN_OR_RETURN(CalibratedArm arm,
                            CalibratedArmFrom(input.nominal(), input.calibration()));
  absl::StatusOr<TableSpec> spec = TableSpecFrom(input.nominal(), CompleteTableSpec(input.spec()));
  if (!spec.ok()) return spec.status();
  return Prepared{std::move(arm), *std::move(spec)};
}

compensation::Digest DigestFrom(const std::string& hex) {
  compensation::Digest digest{};
  const std::string bytes = absl::HexStringToBytes(hex);
  if (bytes.size() == digest.size()) std::memcpy(digest.data(), bytes.data(), bytes.size());
  return digest;
}

int64_t CreatedMicroseconds(const v1::Calibration& calibration) {
  const auto& time = calibration.create_time();
  return time.seconds() * 1'000'000 + time.nanos() / 1000;
}

absl::StatusOr<TableLabels> LabelsOf(const v1::CompensationTableInput& input) {
  const v1::Calibration& calibration = input.calibration();
  TableLabels labels;
  labels.robot = input.robot();
  labels.serial = input.nominal().serial();
  labels.calibration = calibration.name();
  labels.calibration_digest = DigestFrom(calibration.digest());
  labels.nominal_digest = DigestFrom(NominalDigest(input.nominal()));
  labels.created_us = CreatedMicroseconds(calibration);
  FaultList faults;
  const auto check = [&](const compensation::Text& text, const std::string& field) {
    if (!text.valid())
      faults.Add(field, "a text that a table can't hold",
                 absl::StrCat("at most ", compensation::kMostTextBytes, " bytes"));
  };
  check(labels.robot, "robot");
  check(labels.serial, "nominal.serial");
  check(labels.calibration, "calibration.name");
  if (!faults.empty()) return faults.ToStatus();
  return labels;
}

// Of the tool that the spec names, else of the calibrated target, over the table's domain. The
// table's own error comes on top, its rotation by the tool's lever: a plain sum, as if both always
// pointed the same way.
double PredictedAccuracy(const Prepared& prepared, const v1::Calibration& calibration,
                         const compensation::TableContent& content) {
  const auto sources = AccuracySourcesFrom(prepared.arm.calibrated, calibration);
  if (!sources) return 0;
  const Eigen::Vector3d p_F = prepared.spec.box ? prepared.spec.box->X_FT.p : sources->p_F_target;
  const TableDomain domain = DomainOfTable(compensation::MakeTable(content));
  const TableAxes chain(prepared.arm.arm,
                        JointMatrix::Identity(domain.axes.joints(), domain.axes.joints()));
  Random random(prepared.spec.seed);
  std::vector<Eigen::Matrix3d> covariances;
  for (int i = 0; i < kAccuracyPoints; ++i) {
    const JointVector q = domain.axes.ToController(DrawIn(domain, &random));
    covariances.push_back(AccuracyAt(*sources, chain.FromController(q), p_F).covariance);
  }
  const compensation::PoseError& table = content.header.percentile_95;
  return Radius95(covariances) + table.position_m + table.rotation_rad * p_F.norm();
}

v1::CompensationTableEstimate ToProto(const TableEstimate& estimate) {
  v1::CompensationTableEstimate message;
  for (int nodes : estimate.nodes) message.add_nodes(nodes);
  message.set_size_bytes(estimate.bytes);
  message.set_position_m(estimate.error.position_m);
  message.set_rotation_rad(estimate.error.rotation_rad);
  return message;
}

absl::StatusOr<TableFile> FileOf(const BuiltTable& built) {
  const std::vector<std::byte> bytes = compensation::Encode(built.content);
  if (bytes.empty())
    return absl::InternalError(absl::StrCat("a table was built that is none: ",
                                            compensation::Check(built.content).message.data()));
  TableFile file;
  file.bytes.assign(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  file.header = HeaderToProto(compensation::MakeTable(built.content));
  if (built.estimate.poses > 0)
    file.header.set_unreachable_share(static_cast<double>(built.estimate.unreachable) /
                                      built.estimate.poses);
  return file;
}

}  // namespace

absl::StatusOr<TableFile> RunTableBuild(const v1::CompensationTableInput& input,
                                        const RunHooks& hooks) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Prepared prepared, PreparedFrom(input));
  TRUEPOSE_ASSIGN_OR_RETURN(const TableLabels labels, LabelsOf(input));
  TRUEPOSE_ASSIGN_OR_RETURN(BuiltTable built,
                            BuildTable(prepared.arm.arm, prepared.spec, labels, CoreHooks(hooks)));
  built.content.header.predicted_accuracy_95_m =
      PredictedAccuracy(prepared, input.calibration(), built.content);
  return FileOf(built);
}

absl::StatusOr<v1::CompensationTableEstimate> RunTableEstimate(
    const v1::CompensationTableInput& input) {
  TRUEPOSE_ASSIGN_OR_RETURN(const Prepared prepared, PreparedFrom(input));
  TRUEPOSE_ASSIGN_OR_RETURN(const TableEstimate estimate,
                            EstimateTable(prepared.arm.arm, prepared.spec));
  return ToProto(estimate);
}

}  // namespace truepose::convert
