#include "compensation/table_digest.h"

#include "compensation/sha256.h"
#include "compensation/table_layout.h"

namespace truepose::compensation {

Digest DigestOfTable(std::span<const std::byte> file) noexcept {
  Sha256 sha;
  sha.Add(file.first(kDigestAt));
  sha.Add(file.subspan(kFieldsAt));
  return sha.Finish();
}

}  // namespace truepose::compensation
