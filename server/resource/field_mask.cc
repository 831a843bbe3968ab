#include "server/resource/field_mask.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "google/protobuf/util/field_mask_util.h"

namespace truepose::resource {
namespace {

using google::protobuf::FieldMask;
using google::protobuf::Message;
using google::protobuf::util::FieldMaskUtil;

bool IsOfServer(const std::string& path, const std::vector<std::string>& output_only) {
  const std::string first = path.substr(0, path.find('.'));
  return IsStandardField(first) ||
         std::find(output_only.begin(), output_only.end(), first) != output_only.end();
}

absl::Status CheckPaths(const Message& message, const FieldMask& mask,
                        const std::vector<std::string>& output_only) {
  FaultList faults;
  for (const std::string& path : mask.paths()) {
    if (!FieldMaskUtil::GetFieldDescriptors(message.GetDescriptor(), path, nullptr)) {
      faults.Add("update_mask", absl::StrCat("'", path, "'"),
                 absl::StrCat("a field of ", message.GetDescriptor()->name()));
    } else if (IsOfServer(path, output_only)) {
      faults.Add("update_mask", absl::StrCat("'", path, "', which only the server sets"),
                 "fields that may be changed");
    }
  }
  return faults.ToStatus();
}

FieldMask AllChangeable(const Message& message, const std::vector<std::string>& output_only) {
  FieldMask mask;
  const auto* descriptor = message.GetDescriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    const std::string& name = descriptor->field(i)->name();
    if (!IsOfServer(name, output_only)) mask.add_paths(name);
  }
  return mask;
}

}  // namespace

absl::Status ApplyUpdate(const Message& source, const FieldMask& mask,
                         const std::vector<std::string>& output_only, Message& target) {
  const absl::Status checked = CheckPaths(target, mask, output_only);
  if (!checked.ok()) return checked;
  FieldMaskUtil::MergeOptions options;
  options.set_replace_message_fields(true);
  options.set_replace_repeated_fields(true);
  const FieldMask all = AllChangeable(target, output_only);
  FieldMaskUtil::MergeMessageTo(source, mask.paths().empty() ? all : mask, options, &target);
  return absl::OkStatus();
}

}  // namespace truepose::resource
