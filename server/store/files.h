// Files as bytes in pieces, addressed by their SHA-256: equal bytes are stored once. What a file is
// of, the resources that name its digest say.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/transaction.h"

namespace truepose::store {

inline constexpr size_t kPieceBytes = 256 << 10;

// Stores the bytes, unless they are there. @param sha256 of the bytes, lower-case hex; computed by
// the caller, since a transaction holds up the writer.
absl::Status PutFile(Transaction& transaction, std::string_view sha256, std::string_view bytes);

// The piece at `position`, counted from 0; "" after the last. @returns kNotFound for a file that
// isn't there.
absl::StatusOr<std::string> ReadPiece(Snapshot& snapshot, std::string_view sha256,
                                      int64_t position);

absl::StatusOr<bool> HasFile(Snapshot& snapshot, std::string_view sha256);

// With all its pieces; nothing when it isn't there.
absl::Status DropFile(Transaction& transaction, std::string_view sha256);

}  // namespace truepose::store
