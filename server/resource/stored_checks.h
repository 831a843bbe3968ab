// What the content of some kinds must hold of what else is stored: every fault, with the field's
// path within the message. @returns an error of the store only.
#pragma once

#include "absl/status/status.h"
#include "core/base/fault.h"
#include "google/protobuf/message.h"
#include "server/store/resources.h"
#include "server/store/transaction.h"

namespace truepose::resource {

// The joint is one of the robot's; what is told has happened, but for 5 minutes by which clocks may
// differ.
absl::Status CheckRobotEventWithin(store::Transaction& transaction, const store::ResourceKey& key,
                                   const google::protobuf::Message& content, FaultList& faults);
// The pose set is there, and this robot's; one that was deleted since does not keep other fields
// from being changed.
absl::Status CheckPolicyWithin(store::Transaction& transaction, const store::ResourceKey& key,
                               const google::protobuf::Message& content, FaultList& faults);

}  // namespace truepose::resource
