#include "client/cli/resource_kind.h"

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "client/cli/names.h"
#include "google/protobuf/descriptor.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/plant_services.pb.h"
#include "truepose/v1/robot.pb.h"
#include "truepose/v1/services.pb.h"
#include "truepose/v1/session.pb.h"

namespace truepose::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;
using google::protobuf::MessageFactory;

constexpr char kPlantService[] = "truepose.v1.PlantService";

std::vector<ResourceKind> OfThePlant() {
  return {{.word = "instrument",
           .summary = "Instruments: what measures the tool",
           .type = "Instrument",
           .types = "Instruments",
           .collection = "instruments",
           .content = &v1::Instrument::default_instance(),
           .service = kPlantService,
           .columns = {"model", "serial", "position_sd_mm", "certificate_expire_time"},
           .example_id = "lt-1",
           .example_set = "serial=4711 position_sd_mm=0.02"},
          {.word = "tool",
           .summary = "Tools: what is mounted on a flange",
           .type = "RegisteredTool",
           .types = "RegisteredTools",
           .collection = "tools",
           .content = &v1::RegisteredTool::default_instance(),
           .service = kPlantService,
           .columns = {"pose.x_mm", "pose.y_mm", "pose.z_mm", "mass_kg", "version"},
           .example_id = "gripper-2",
           .example_set = "pose.z_mm=145.5 mass_kg=1.2"},
          {.word = "fixture",
           .summary = "Fixtures: features known better than the robot",
           .type = "RegisteredFixture",
           .types = "RegisteredFixtures",
           .collection = "fixtures",
           .content = &v1::RegisteredFixture::default_instance(),
           .service = kPlantService,
           .columns = {"fixture.features", "certificate", "certificate_expire_time", "version"},
           .example_id = "sockets",
           .example_set = "certificate=K-2026-17"},
          {.word = "target",
           .summary = "Targets: reflectors, balls and probes on a flange",
           .type = "Target",
           .types = "Targets",
           .collection = "targets",
           .content = &v1::Target::default_instance(),
           .service = kPlantService,
           .columns = {"pose.x_mm", "pose.y_mm", "pose.z_mm"},
           .example_id = "smr-a",
           .example_set = "pose.x_mm=25 pose.z_mm=80"}};
}

std::vector<ResourceKind> OfARobot() {
  return {{.word = "placement",
           .summary = "Placements: standings of an instrument or fixture at a robot",
           .type = "Placement",
           .types = "Placements",
           .collection = "placements",
           .of_robot = true,
           .content = &v1::Placement::default_instance(),
           .service = kPlantService,
           .columns = {"instrument"},
           .example_id = "ur10/floor-a",
           .example_set = "instrument=instruments/lt-1"},
          {.word = "pose-set",
           .summary = "Pose sets: joints to go to, for a calibration or a check",
           .type = "PoseSet",
           .types = "PoseSets",
           .collection = "poseSets",
           .of_robot = true,
           .content = &v1::PoseSet::default_instance(),
           .service = kPlantService,
           .output_only = {"origin"},
           .columns = {"purpose", "poses", "origin"},
           .example_id = "ur10/daily",
           .example_set = "purpose=POSE_SET_CHECK"}};
}

FieldDescriptor const* FieldOfType(const Message& message, const Message& type) {
  const auto* descriptor = message.GetDescriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    if (descriptor->field(i)->message_type() == type.GetDescriptor()) return descriptor->field(i);
  }
  return nullptr;
}

// "truepose.v1." and the type; all requests are linked with the ones that are named here.
std::unique_ptr<Message> NewMessage(const std::string& type) {
  const auto* pool = v1::CreateInstrumentRequest::descriptor()->file()->pool();
  const auto* descriptor = pool->FindMessageTypeByName(absl::StrCat("truepose.v1.", type));
  return std::unique_ptr<Message>(
      MessageFactory::generated_factory()->GetPrototype(descriptor)->New());
}

std::string MethodOf(const ResourceKind& kind, const std::string& verb) {
  return absl::StrCat(verb, verb == "List" ? kind.types : kind.type);
}

}  // namespace

const std::vector<ResourceKind>& PlantKinds() {
  static const auto& kinds = *[] {
    auto* all = new std::vector<ResourceKind>(OfThePlant());
    for (ResourceKind& kind : OfARobot()) all->push_back(std::move(kind));
    return all;
  }();
  return kinds;
}

const ResourceKind& RobotKindOfResource() {
  static const auto& kind = *new ResourceKind{
      .word = "robot",
      .type = "Robot",
      .types = "Robots",
      .collection = "robots",
      .content = &v1::Robot::default_instance(),
      .service = "truepose.v1.RobotService",
      .output_only = {"nominal_revision", "active_calibration", "active_compensation_table"},
      .hidden = "nominal_revision.nominal.",
      .example_id = "ur10",
      .example_set = "release_policy=ONE_PERSON limits.drift_rms_mm=0.3"};
  return kind;
}

const ResourceKind& SessionKindOfResource() {
  static const auto& kind = *new ResourceKind{
      .word = "session",
      .type = "Session",
      .types = "Sessions",
      .collection = "sessions",
      .content = &v1::Session::default_instance(),
      .service = "truepose.v1.SessionService",
      .output_only = {"robot", "nominal_revision", "source", "extra_columns", "state",
                      "reading_count", "digest", "seal_time", "sealed_by", "created_by"},
      .example_id = "5f0c2c1e-8a53-4f0e-9a51-6f1f0f1f7a11",
      .example_set = "operator='A. Smith' temperature_c=21.5"};
  return kind;
}

std::string ResourceName(const ResourceKind& kind, const std::string& typed) {
  if (absl::StartsWith(typed, kind.collection + "/")) return typed;
  if (!kind.of_robot) return absl::StrCat(kind.collection, "/", typed);
  const std::vector<std::string> parts = absl::StrSplit(typed, '/');
  if (parts.size() != 2) return typed;
  return absl::StrCat(RobotName(parts[0]), "/", kind.collection, "/", parts[1]);
}

std::string ShortResourceName(const ResourceKind& kind, const std::string& name) {
  const std::vector<std::string> parts = absl::StrSplit(name, '/');
  if (kind.of_robot && parts.size() == 4) return absl::StrCat(parts[1], "/", parts[3]);
  return parts.size() == 2 ? parts[1] : name;
}

std::vector<std::string> OutputOnly(const ResourceKind& kind) {
  std::vector<std::string> fields = {"name",        "uid",      "create_time", "update_time",
                                     "delete_time", "revision", "etag",        "version"};
  fields.insert(fields.end(), kind.output_only.begin(), kind.output_only.end());
  return fields;
}

StandardCall::StandardCall(const ResourceKind& kind, const std::string& verb)
    : method(absl::StrCat(kind.service, "/", MethodOf(kind, verb))),
      request(NewMessage(MethodOf(kind, verb) + "Request")),
      response(NewMessage(verb == "List" ? MethodOf(kind, verb) + "Response" : kind.type)) {}

void StandardCall::Set(const std::string& field, const std::string& text) {
  const FieldDescriptor* found = request->GetDescriptor()->FindFieldByName(field);
  if (found != nullptr) request->GetReflection()->SetString(request.get(), found, text);
}

void StandardCall::Set(const std::string& field, bool flag) {
  const FieldDescriptor* found = request->GetDescriptor()->FindFieldByName(field);
  if (found != nullptr) request->GetReflection()->SetBool(request.get(), found, flag);
}

Message& StandardCall::content(const ResourceKind& kind) {
  const FieldDescriptor* field = FieldOfType(*request, *kind.content);
  return *request->GetReflection()->MutableMessage(request.get(), field);
}

absl::Status StandardCall::Run(const client::Client& client) {
  return client.CallMethod(method, *request, response.get());
}

}  // namespace truepose::cli
