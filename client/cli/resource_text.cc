#include "client/cli/resource_text.h"

#include <algorithm>

#include "absl/strings/ascii.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_replace.h"
#include "client/cli/table.h"
#include "formats/message_text.h"
#include "google/protobuf/descriptor.h"

namespace truepose::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

using Fields = std::vector<formats::FieldText>;

std::string TextAt(const Fields& fields, const std::string& key) {
  const auto found =
      std::find_if(fields.begin(), fields.end(),
                   [&](const formats::FieldText& field) { return field.key == key; });
  return found == fields.end() ? "" : found->text;
}

// The field of a list's response that has the items.
const FieldDescriptor* ItemsOf(const Message& response) {
  const auto* descriptor = response.GetDescriptor();
  for (int i = 0; i < descriptor->field_count(); ++i) {
    if (descriptor->field(i)->is_repeated()) return descriptor->field(i);
  }
  return nullptr;
}

std::string Title(const std::string& key) { return absl::StrReplaceAll(key, {{"_", " "}}); }

Table WithColumns(const ResourceKind& kind) {
  std::vector<Column> columns = {{kind.word, Align::kLeft}, {"name", Align::kLeft}};
  for (const std::string& key : kind.columns) columns.push_back({Title(key), Align::kLeft});
  columns.push_back({"deleted", Align::kLeft});
  return Table(columns);
}

}  // namespace

std::string ResourceText(const ResourceKind& kind, const Message& resource) {
  const Fields fields = formats::DescribeMessage(resource);
  std::string word = kind.word;
  word[0] = absl::ascii_toupper(word[0]);
  std::string text = absl::StrCat(word, " ", ShortResourceName(kind, TextAt(fields, "name")), "\n");
  const auto shown = [&](const std::string& key) {
    const bool hidden = !kind.hidden.empty() && key.starts_with(kind.hidden);
    return !hidden && key != "name" && key != "uid";
  };
  size_t widest = 0;
  for (const formats::FieldText& field : fields) {
    if (shown(field.key)) widest = std::max(widest, field.key.size());
  }
  for (const formats::FieldText& field : fields) {
    if (!shown(field.key)) continue;
    absl::StrAppend(&text, "  ", field.key, std::string(widest - field.key.size(), ' '), "  ",
                    field.text, "\n");
  }
  return text;
}

std::string ResourcesTable(const ResourceKind& kind, const Message& response) {
  const FieldDescriptor* items = ItemsOf(response);
  const auto* reflection = response.GetReflection();
  Table table = WithColumns(kind);
  for (int i = 0; i < reflection->FieldSize(response, items); ++i) {
    const Fields fields =
        formats::DescribeMessage(reflection->GetRepeatedMessage(response, items, i));
    std::vector<std::string> cells = {ShortResourceName(kind, TextAt(fields, "name")),
                                      TextAt(fields, "display_name")};
    for (const std::string& key : kind.columns) cells.push_back(TextAt(fields, key));
    cells.push_back(TextAt(fields, "delete_time"));
    table.Add(std::move(cells));
  }
  if (!table.empty()) return table.Text();
  return absl::StrCat("None yet. Next: truepose ", kind.word, " create ", kind.example_id,
                      " --set ", kind.example_set, "\n");
}

}  // namespace truepose::cli
