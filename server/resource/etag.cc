#include "server/resource/etag.h"

#include "absl/strings/str_cat.h"
#include "server/store/message.h"

namespace truepose::resource {

absl::Status CheckEtag(const std::string& stored, const std::string& asked) {
  if (asked.empty() || asked == stored) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kAborted, "etag", asked,
                        absl::StrCat(stored, ": it was changed meanwhile; get it again"));
}

}  // namespace truepose::resource
