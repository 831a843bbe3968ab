#include "server/resource/registry.h"

#include "server/resource/checks.h"
#include "server/resource/stored_checks.h"
#include "server/store/open_request.h"
#include "truepose/v1/compensation_table.pb.h"
#include "truepose/v1/plant.pb.h"
#include "truepose/v1/recalibration.pb.h"

namespace truepose::resource {
namespace {

template <typename T>
const google::protobuf::Message* Prototype() {
  return &T::default_instance();
}

// What stands around the robots.
std::vector<ResourceType> PlantTypes() {
  return {
      {.kind = v1::KIND_INSTRUMENT,
       .prototype = Prototype<v1::Instrument>(),
       .collection = "instruments",
       .check = CheckInstrument},
      {.kind = v1::KIND_TOOL,
       .prototype = Prototype<v1::RegisteredTool>(),
       .collection = "tools",
       .check = CheckTool,
       .versioned = {"pose", "mass_kg"}},
      {.kind = v1::KIND_FIXTURE,
       .prototype = Prototype<v1::RegisteredFixture>(),
       .collection = "fixtures",
       .check = CheckFixture,
       .versioned = {"fixture"}},
      {.kind = v1::KIND_TARGET,
       .prototype = Prototype<v1::Target>(),
       .collection = "targets",
       .check = CheckTarget},
      {.kind = v1::KIND_PLACEMENT,
       .prototype = Prototype<v1::Placement>(),
       .collection = "placements",
       .of_robot = true,
       .check = CheckPlacement},
      {.kind = v1::KIND_POSE_SET,
       .prototype = Prototype<v1::PoseSet>(),
       .collection = "poseSets",
       .of_robot = true,
       .check = CheckPoseSet},
  };
}

bool HasInterval(const google::protobuf::Message& policy) {
  return static_cast<const v1::RecalibrationPolicy&>(policy).has_interval();
}

bool IsOpenRequest(const google::protobuf::Message& request) {
  return store::IsOpen(static_cast<const v1::RecalibrationRequest&>(request).state());
}

// What leads to a recalibration.
std::vector<ResourceType> RecalibrationTypes() {
  return {
      {.kind = v1::KIND_ROBOT_EVENT,
       .prototype = Prototype<v1::RobotEvent>(),
       .collection = "events",
       .of_robot = true,
       .uuid_ids = true,
       .output_only = {"created_by"},
       .check = CheckRobotEvent,
       .check_within = CheckRobotEventWithin},
      {.kind = v1::KIND_RECALIBRATION_POLICY,
       .prototype = Prototype<v1::RecalibrationPolicy>(),
       .collection = "recalibrationPolicies",
       .of_robot = true,
       .check = CheckRecalibrationPolicy,
       .check_within = CheckPolicyWithin,
       .is_open = HasInterval},
      {.kind = v1::KIND_RECALIBRATION_REQUEST,
       .prototype = Prototype<v1::RecalibrationRequest>(),
       .collection = "recalibrationRequests",
       .of_robot = true,
       .uuid_ids = true,
       .output_only = {"state", "created_by", "session", "job", "calibration", "steps",
                       "readings_taken"},
       .check = CheckNothing,
       .is_open = IsOpenRequest},
      {.kind = v1::KIND_DRIFT_CHECK,
       .prototype = Prototype<v1::DriftCheck>(),
       .collection = "driftChecks",
       .of_robot = true,
       .uuid_ids = true,
       .check = CheckNothing},
      {.kind = v1::KIND_AGENT_REPORT,
       .prototype = Prototype<v1::AgentReport>(),
       .collection = "agentReports",
       .check = CheckAgentReport},
  };
}

// What reaches a controller.
std::vector<ResourceType> CompensationTypes() {
  return {
      {.kind = v1::KIND_COMPENSATION_TABLE,
       .prototype = Prototype<v1::CompensationTable>(),
       .collection = "compensationTables",
       .of_robot = true,
       .uuid_ids = true,
       .output_only = {"state", "job", "error", "size_bytes", "sha256", "input_digest",
                       "calibration_digest", "nominal_digest", "header", "estimate", "created_by"},
       .check = CheckCompensationTable},
  };
}

// Built at the first call: descriptors of protobuf are not there before main() begins.
const std::vector<ResourceType>& Registry() {
  static const std::vector<ResourceType>& types = *[] {
    auto* all = new std::vector<ResourceType>(PlantTypes());
    for (ResourceType& type : RecalibrationTypes()) all->push_back(std::move(type));
    for (ResourceType& type : CompensationTypes()) all->push_back(std::move(type));
    return all;
  }();
  return types;
}

}  // namespace

std::span<const ResourceType> AllTypes() { return Registry(); }

const ResourceType* FindType(const google::protobuf::Descriptor* descriptor) {
  for (const ResourceType& type : Registry()) {
    if (type.prototype->GetDescriptor() == descriptor) return &type;
  }
  return nullptr;
}

const ResourceType* FindType(v1::ResourceKind kind) {
  for (const ResourceType& type : Registry()) {
    if (type.kind == kind) return &type;
  }
  return nullptr;
}

}  // namespace truepose::resource
