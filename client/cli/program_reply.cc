#include "client/cli/program_reply.h"

#include <map>
#include <string_view>

#include "absl/strings/str_cat.h"
#include "client/cli/json_value.h"
#include "client/cli/table.h"
#include "formats/text_file.h"
#include "programs/diff.h"
#include "programs/lines.h"

namespace truepose::cli {
namespace {

using programs::Remark;

// Programs come in code pages of their own; what we print is UTF-8.
std::string AsUtf8(std::string_view text) {
  std::string result;
  while (true) {
    const size_t bad = formats::FindNotUtf8(text);
    result += text.substr(0, bad);
    if (bad == std::string_view::npos) return result;
    result += "\xEF\xBF\xBD";
    text.remove_prefix(bad + 1);
  }
}

// "  lines 3, 7-9: reason", the reasons in the order in which they first came.
std::string ByReason(const std::vector<Remark>& remarks) {
  std::vector<std::string> reasons;
  std::map<std::string, std::vector<int>> lines;
  for (const Remark& remark : remarks) {
    std::vector<int>& of_reason = lines[remark.reason];
    if (of_reason.empty()) reasons.push_back(remark.reason);
    of_reason.push_back(remark.line);
  }
  std::string text;
  for (const std::string& reason : reasons) {
    const std::string numbers = programs::LineNumbers(lines[reason]);
    const bool one = numbers.find_first_of(",-") == std::string::npos;
    absl::StrAppend(&text, one ? "  line " : "  lines ", numbers, ": ", AsUtf8(reason), "\n");
  }
  return text;
}

std::string Section(absl::string_view title, const std::vector<Remark>& remarks) {
  return remarks.empty() ? "" : absl::StrCat(title, "\n", ByReason(remarks));
}

std::string DiffOf(const ProgramFiles& files, const programs::CorrectedProgram& corrected) {
  if (!files.diff) return "";
  return programs::UnifiedDiff(files.before, corrected.text, files.input, files.output,
                               corrected.mark_line);
}

google::protobuf::Value Numbers(const std::vector<double>& numbers) {
  return List(numbers, Number);
}

google::protobuf::Value Changed(const programs::Change& change) {
  return Object(StructOf({{"line", Number(change.line)},
                          {"what", Text(AsUtf8(change.what))},
                          {"before", Numbers(change.before)},
                          {"after", Numbers(change.after)}}));
}

google::protobuf::Value Remarks(const std::vector<Remark>& remarks,
                                const std::vector<std::string_view>& lines) {
  return List(remarks, [&](const Remark& remark) {
    const std::string line = programs::Excerpt(lines[static_cast<size_t>(remark.line) - 1]);
    return Object(StructOf({{"line", Number(remark.line)},
                            {"text", Text(AsUtf8(line))},
                            {"reason", Text(AsUtf8(remark.reason))}}));
  });
}

}  // namespace

std::string ProgramText(const ProgramFiles& files, const programs::CorrectedProgram& corrected) {
  return absl::StrCat(
      Count(static_cast<long long>(corrected.changes.size()), "joint target"), " corrected, in ",
      files.output, "\n",
      Section("Targets that could not be corrected and stay as they were:", corrected.uncorrected),
      Section("Not corrected, passed through as it is:", corrected.passed_through),
      DiffOf(files, corrected));
}

google::protobuf::Struct ProgramJson(const ProgramFiles& files,
                                     const programs::CorrectedProgram& corrected) {
  const std::vector<std::string_view> lines = programs::LinesOf(files.before);
  google::protobuf::Struct json =
      StructOf({{"output", Text(AsUtf8(files.output))},
                {"dialect", Text(std::string(programs::NameOf(files.dialect)))},
                {"corrected", List(corrected.changes, Changed)},
                {"uncorrected", Remarks(corrected.uncorrected, lines)},
                {"passed_through", Remarks(corrected.passed_through, lines)},
                {"mark_line", Number(corrected.mark_line)}});
  if (files.diff) (*json.mutable_fields())["diff"] = Text(AsUtf8(DiffOf(files, corrected)));
  return json;
}

}  // namespace truepose::cli
