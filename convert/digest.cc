#include "convert/digest.h"

#include <openssl/evp.h>

#include <algorithm>

#include "absl/strings/escaping.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_format.h"
#include "convert/run.h"

namespace truepose::convert {
namespace {

// A line `name value`; texts are escaped, so that no text can pass for two lines.
class Lines {
 public:
  void Add(const std::string& name, double value) {
    absl::StrAppend(&text_, name, " ", absl::StrFormat("%a", value), "\n");
  }
  void Add(const std::string& name, const std::string& value) {
    absl::StrAppend(&text_, name, " ", absl::CEscape(value), "\n");
  }
  void Add(const std::string& name, const v1::Vector3& v) {
    Add(name + ".x", v.x());
    Add(name + ".y", v.y());
    Add(name + ".z", v.z());
  }
  std::string Digest() const { return Sha256(text_); }

 private:
  std::string text_;
};

void AddElement(const std::string& field, const v1::ElementaryTransform& element, Lines* lines) {
  const char* motion = element.motion() == v1::ElementaryTransform::ROTATION ? "R" : "T";
  lines->Add(field, absl::StrCat(motion, static_cast<int>(element.axis()), " joint ",
                                 element.has_joint() ? element.joint() : -1));
  lines->Add(field + ".constant", element.constant());
}

void AddTable(const std::string& field, const v1::DhTable& table, Lines* lines) {
  for (int i = 0; i < table.rows_size(); ++i) {
    const std::string row = absl::StrCat(field, "[", i, "]");
    lines->Add(row + ".theta_rad", table.rows(i).theta_rad());
    lines->Add(row + ".d_m", table.rows(i).d_m());
    lines->Add(row + ".a_m", table.rows(i).a_m());
    lines->Add(row + ".alpha_rad", table.rows(i).alpha_rad());
  }
}

void AddGeometry(const v1::Geometry& geometry, Lines* lines) {
  AddTable("standard_dh", geometry.standard_dh(), lines);
  AddTable("craig_dh", geometry.craig_dh(), lines);
  for (int i = 0; i < geometry.chain().elements_size(); ++i) {
    AddElement(absl::StrCat("chain[", i, "]"), geometry.chain().elements(i), lines);
  }
  for (int i = 0; i < geometry.flange_size(); ++i) {
    AddElement(absl::StrCat("flange[", i, "]"), geometry.flange(i), lines);
  }
}

void AddJoint(const std::string& field, const v1::Joint& joint, Lines* lines) {
  lines->Add(field + ".name", joint.name());
  lines->Add(field + ".type", v1::JointType_Name(joint.type()));
  if (joint.has_lower()) lines->Add(field + ".lower", joint.lower());
  if (joint.has_upper()) lines->Add(field + ".upper", joint.upper());
}

void AddPose(const std::string& field, const v1::Pose& pose, Lines* lines) {
  lines->Add(field + ".x_m", pose.x_m());
  lines->Add(field + ".y_m", pose.y_m());
  lines->Add(field + ".z_m", pose.z_m());
  lines->Add(field + ".qx", pose.qx());
  lines->Add(field + ".qy", pose.qy());
  lines->Add(field + ".qz", pose.qz());
  lines->Add(field + ".qw", pose.qw());
}

void AddNumbers(const std::string& field, const google::protobuf::RepeatedField<double>& values,
                Lines* lines) {
  for (int i = 0; i < values.size(); ++i) lines->Add(absl::StrCat(field, "[", i, "]"), values[i]);
}

void AddMass(const std::string& field, const v1::LinkMass& mass, Lines* lines) {
  lines->Add(field + ".joint", absl::StrCat(mass.joint()));
  lines->Add(field + ".mass_kg", mass.mass_kg());
  lines->Add(field + ".x_m", mass.x_m());
  lines->Add(field + ".y_m", mass.y_m());
  lines->Add(field + ".z_m", mass.z_m());
}

// A text that is not there has no line: what is new must not change the digests of what is old.
void AddText(const std::string& name, const std::string& value, Lines* lines) {
  if (!value.empty()) lines->Add(name, value);
}

// What a reading may have beside a pose, and most do not.
void AddFurther(const std::string& row, const v1::Reading& reading, Lines* lines) {
  for (int i = 0; i < reading.points_size(); ++i) {
    const v1::MeasuredPoint& point = reading.points(i);
    const std::string field = absl::StrCat(row, ".points[", i, "]");
    lines->Add(field + ".target", point.target());
    lines->Add(field + ".position_m", point.position_m());
    if (point.has_position_sd_m()) lines->Add(field + ".position_sd_m", point.position_sd_m());
  }
  AddText(row + ".coordinates", reading.coordinates(), lines);
  if (reading.has_distance_m()) lines->Add(row + ".distance_m", reading.distance_m());
  if (reading.has_distance_sd_m()) lines->Add(row + ".distance_sd_m", reading.distance_sd_m());
  AddText(row + ".anchor", reading.anchor(), lines);
  AddText(row + ".beam", reading.beam(), lines);
  AddText(row + ".feature", reading.feature(), lines);
}

void AddFixture(const v1::Fixture& fixture, Lines* lines) {
  lines->Add("fixture", fixture.name());
  for (const v1::Feature& feature : fixture.features()) {
    lines->Add("feature", feature.name());
    lines->Add("feature.kind", v1::FeatureKind_Name(feature.kind()));
    AddPose("feature.pose", feature.pose(), lines);
    AddNumbers("feature.covariance", feature.covariance(), lines);
  }
}

void AddPrior(const v1::PriorCalibration& prior, Lines* lines) {
  lines->Add("prior_calibration", prior.name());
  lines->Add("prior_calibration.convention", prior.convention());
  for (const v1::InternalParameter& parameter : prior.internal_parameters())
    lines->Add("prior_calibration.value " + absl::CEscape(parameter.name()), parameter.value());
  for (const std::string& name : prior.identified())
    lines->Add("prior_calibration.identified", name);
  AddNumbers("prior_calibration.covariance", prior.covariance(), lines);
  lines->Add("prior_calibration.model_sd_position_mm", prior.model_sd_position_mm());
  lines->Add("prior_calibration.model_sd_rotation_deg", prior.model_sd_rotation_deg());
  for (const v1::FrameEstimate& frame : prior.frames()) {
    lines->Add("prior_calibration.frame", frame.name());
    AddPose("prior_calibration.frame", frame.pose(), lines);
  }
}

// Options that most jobs leave empty.
void AddFurtherOptions(const v1::CalibrationOptions& options, Lines* lines) {
  AddText("select", options.select(), lines);
  AddText("effects", options.effects(), lines);
  AddText("loss", options.loss(), lines);
  AddText("calibrate", options.calibrate(), lines);
  AddText("prior", options.prior(), lines);
  if (options.has_prior_calibration()) AddPrior(options.prior_calibration(), lines);
  if (options.has_fixture()) AddFixture(options.fixture(), lines);
  AddText("feature_column", options.feature_column(), lines);
  AddNumbers("joint_sd", options.joint_sd(), lines);
  AddText("pose_matching", options.pose_matching(), lines);
  AddText("joints", options.joints(), lines);
  AddText("objective", options.objective(), lines);
}

void AddReading(const v1::Reading& reading, Lines* lines) {
  const std::string row = absl::StrCat("row[", reading.row(), "]");
  AddNumbers(row + ".joints_measured", reading.joints_measured(), lines);
  AddNumbers(row + ".joints_commanded", reading.joints_commanded(), lines);
  if (reading.has_position_m()) lines->Add(row + ".position_m", reading.position_m());
  if (reading.has_orientation()) {
    const v1::Quaternion& q = reading.orientation();
    lines->Add(row + ".orientation", absl::StrFormat("%a %a %a %a", q.x(), q.y(), q.z(), q.w()));
  }
  if (reading.has_axis()) lines->Add(row + ".axis", reading.axis());
  if (reading.has_position_sd_m()) lines->Add(row + ".position_sd_m", reading.position_sd_m());
  lines->Add(row + ".time", reading.time());
  lines->Add(row + ".placement", reading.placement());
  lines->Add(row + ".target", reading.target());
  lines->Add(row + ".group", reading.group());
  if (reading.has_temperature_c()) lines->Add(row + ".temperature_c", reading.temperature_c());
  AddNumbers(row + ".joint_torques_nm", reading.joint_torques_nm(), lines);
  for (const std::string& value : reading.extra_values()) lines->Add(row + ".extra", value);
  AddFurther(row, reading, lines);
}

}  // namespace

std::string Sha256(const std::string& text) {
  unsigned char hash[EVP_MAX_MD_SIZE];
  unsigned int size = 0;
  EVP_Digest(text.data(), text.size(), hash, &size, EVP_sha256(), nullptr);
  return absl::BytesToHexString(std::string(reinterpret_cast<const char*>(hash), size));
}

std::string RowsDigest(const std::vector<std::pair<int, int>>& session_rows) {
  std::string text;
  for (const auto& [session, row] : session_rows) absl::StrAppend(&text, session, " ", row, "\n");
  return Sha256(text);
}

std::string CalibrationDigest(const std::string& convention, const std::string& nominal_digest,
                              const v1::Calibration& calibration) {
  std::vector<std::string> values;
  for (const v1::InternalParameter& parameter : calibration.internal_parameters()) {
    values.push_back(
        absl::StrCat(parameter.name(), " ", absl::StrFormat("%a", parameter.value()), "\n"));
  }
  std::sort(values.begin(), values.end());
  std::string text = absl::StrCat("convention ", convention, "\nnominal ", nominal_digest, "\n");
  for (const std::string& value : values) absl::StrAppend(&text, value);
  return Sha256(text);
}

std::string NominalDigest(const v1::Nominal& nominal) {
  Lines lines;
  lines.Add("serial", nominal.serial());
  lines.Add("manufacturer", nominal.manufacturer());
  lines.Add("model", nominal.model());
  lines.Add("kind", v1::RobotKind_Name(nominal.kind()));
  for (int i = 0; i < nominal.joints_size(); ++i)
    AddJoint(absl::StrCat("joint[", i, "]"), nominal.joints(i), &lines);
  AddGeometry(nominal.geometry(), &lines);
  AddNumbers("joint_map.scale", nominal.joint_map().scale(), &lines);
  AddNumbers("joint_map.offset", nominal.joint_map().offset(), &lines);
  for (const v1::Tool& tool : nominal.tools()) {
    lines.Add("tool", tool.name());
    AddPose("tool.pose", tool.pose(), &lines);
  }
  for (int i = 0; i < nominal.masses_size(); ++i)
    AddMass(absl::StrCat("mass[", i, "]"), nominal.masses(i), &lines);
  return lines.Digest();
}

std::string ReadingsDigest(const std::vector<v1::Reading>& readings) {
  Lines lines;
  for (const v1::Reading& reading : readings) AddReading(reading, &lines);
  return lines.Digest();
}

std::string JobInputDigest(const std::string& nominal_digest,
                           const std::vector<std::string>& session_digests,
                           const v1::CalibrationOptions& options) {
  Lines lines;
  lines.Add("nominal", nominal_digest);
  for (const std::string& digest : session_digests) lines.Add("session", digest);
  lines.Add("split", options.split());
  lines.Add("group_column", options.group_column());
  lines.Add("observe", v1::Observe_Name(options.observe()));
  lines.Add("require_complete", std::string(options.require_complete() ? "true" : "false"));
  lines.Add("strict_limits", std::string(options.strict_limits() ? "true" : "false"));
  lines.Add("model", options.model());
  lines.Add("estimator", options.estimator());
  lines.Add("nominal_tool", options.nominal_tool());
  AddFurtherOptions(options, &lines);
  return lines.Digest();
}

}  // namespace truepose::convert
