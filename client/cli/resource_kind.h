// The kinds of resources that have the standard methods, as the command line speaks of them; their
// messages are found by descriptor.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "absl/status/status.h"
#include "client/client.h"
#include "google/protobuf/message.h"

namespace truepose::cli {

struct ResourceKind {
  std::string word;          // "pose-set"
  std::string summary = {};  // of --help
  std::string type;          // "PoseSet", as the methods are called: CreatePoseSet
  std::string types;         // "PoseSets", of ListPoseSets
  std::string collection;    // "poseSets"
  bool of_robot = false;     // robots/{robot}/{collection}/{id}
  const google::protobuf::Message* content = nullptr;  // default instance
  std::string service;                                 // "truepose.v1.PlantService"
  // Fields that only the server sets, beside those of every resource.
  std::vector<std::string> output_only = {};
  std::vector<std::string> columns = {};  // of the list, as keys for people
  std::string hidden = {};                // keys that begin so are shown by another command
  std::string example_id;                 // "lt-1", "ur10/base-1"
  std::string example_set;                // "serial=4711 position_sd_mm=0.02"
};

// instrument, tool, fixture, target, placement, pose-set.
const std::vector<ResourceKind>& PlantKinds();
// Of robots and sessions update, delete and undelete only; the rest has commands of its own.
const ResourceKind& RobotKindOfResource();
const ResourceKind& SessionKindOfResource();

// "lt-1" or "instruments/lt-1" -> the latter; of a robot: "ur10/base-1" or the whole name.
std::string ResourceName(const ResourceKind& kind, const std::string& typed);
// The other way round.
std::string ShortResourceName(const ResourceKind& kind, const std::string& name);

// Names that only the server sets: those of every resource and the kind's own.
std::vector<std::string> OutputOnly(const ResourceKind& kind);

// The method of `verb` ("Create", "Get", "List", "Update", "Delete", "Undelete"), and new messages
// for it.
struct StandardCall {
  StandardCall(const ResourceKind& kind, const std::string& verb);

  std::string method;  // "truepose.v1.PlantService/CreatePoseSet"
  std::unique_ptr<google::protobuf::Message> request;
  std::unique_ptr<google::protobuf::Message> response;

  // Of the request, by name; nothing when it has no such field.
  void Set(const std::string& field, const std::string& text);
  void Set(const std::string& field, bool flag);
  // The resource that a create or update carries.
  google::protobuf::Message& content(const ResourceKind& kind);
  absl::Status Run(const client::Client& client);
};

}  // namespace truepose::cli
