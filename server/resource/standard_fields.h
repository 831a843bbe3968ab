// The fields that every resource has, set by name: name, uid, create_time, update_time,
// delete_time, revision, etag, version (docs/api.md).
#pragma once

#include <string>

#include "google/protobuf/message.h"
#include "server/resource/resource_type.h"
#include "server/store/transaction.h"

namespace truepose::resource {

std::string GetText(const google::protobuf::Message& message, const char* field);
bool IsDeleted(const google::protobuf::Message& resource);

// Empties what only the server sets, so that contents can be compared and stored.
void ClearServerFields(const ResourceType& type, google::protobuf::Message& resource);

// Takes over what only the server sets from the stored state.
void CopyServerFields(const ResourceType& type, const google::protobuf::Message& stored,
                      google::protobuf::Message& resource);

// A caller's content before it is stored: without what only the server sets, with `created_by`
// where the kind has it.
void PrepareContent(const ResourceType& type, const std::string& principal,
                    google::protobuf::Message& content);

// The first state: name, uid, create_time, version 1 and what Restamp sets.
void StampNew(const store::Transaction& transaction, const std::string& name,
              google::protobuf::Message& resource);
// A later state: update_time, revision, etag.
void Restamp(const store::Transaction& transaction, google::protobuf::Message& resource);
// Sets delete_time to now, or clears it.
void SetDeleted(const store::Transaction& transaction, bool deleted,
                google::protobuf::Message& resource);
// Raises `version` when a versioned field of `resource` differs from the stored state's.
void RaiseVersion(const ResourceType& type, const google::protobuf::Message& stored,
                  google::protobuf::Message& resource);

}  // namespace truepose::resource
