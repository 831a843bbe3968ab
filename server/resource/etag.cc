#include "server/resource/etag.h"

#include "absl/strings/str_cat.h"
#include "absl/strings/strip.h"
#include "server/store/message.h"

namespace truepose::resource {

namespace {

// A shell takes the quotes of "11" away.
absl::string_view Unquoted(absl::string_view etag) {
  if (absl::ConsumePrefix(&etag, "\"")) absl::ConsumeSuffix(&etag, "\"");
  return etag;
}

}  // namespace

absl::Status CheckEtag(const std::string& stored, const std::string& asked) {
  if (asked.empty() || Unquoted(asked) == Unquoted(stored)) return absl::OkStatus();
  return store::Refusal(absl::StatusCode::kAborted, "etag", asked,
                        absl::StrCat(stored, ": it was changed meanwhile; get it again"));
}

}  // namespace truepose::resource
