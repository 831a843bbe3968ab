// From what a call shows to who calls.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "absl/time/time.h"
#include "server/auth/caller.h"
#include "server/store/store.h"
#include "server/store/tokens.h"

namespace truepose::auth {

// The use of a token is recorded when the record is older than this: who wants to know which tokens
// are dead needs no more, and a write with each call would cost as much as the call.
inline constexpr absl::Duration kUseResolution = absl::Hours(1);

// All functions are safe from any thread and never wait for the store.
class Authenticator {
 public:
  // Asks nobody: everybody is local-dev.
  static std::unique_ptr<Authenticator> OpenToAll();
  // The tokens of a store, which outlives it. @returns the store's status.
  static absl::StatusOr<std::unique_ptr<Authenticator>> Load(store::Store& store);

  // @param authorization the call's metadata of that name, "Bearer SECRET"; "" = there is none.
  // @returns kUnauthenticated with a fault of `authorization` that says what to do: nothing shown,
  // another form, unknown, revoked, expired. Neither the fault nor any log has the secret.
  absl::StatusOr<Caller> Authenticate(std::string_view authorization);
  // Whether who was admitted to a stream still may go on. @returns kUnauthenticated.
  absl::Status Recheck(const Caller& caller) const;

  // A token that was committed, new or changed. What was revoked stays so, in whatever order two
  // commits are told. Its secret is the one told last; "" = as before.
  void Learn(const store::StoredToken& token);

  // Whether an admin's token is neither revoked nor expired.
  bool HasAdmin() const;
  bool is_open_to_all() const { return store_ == nullptr; }

 private:
  explicit Authenticator(store::Store* store) : store_(store) {}
  absl::Status CheckHolds(const v1::Token& token) const;
  void RecordUse(store::StoredToken& token);
  void LearnSecret(const std::string& secret_sha256, store::StoredToken& token);  // holds mutex_

  store::Store* const store_;                                   // nullptr = open to all
  mutable std::mutex mutex_;                                    // of all below
  std::map<std::string, store::StoredToken> tokens_;            // by name
  std::unordered_map<std::string, std::string> names_of_hash_;  // hash of the secret -> name
};

}  // namespace truepose::auth
