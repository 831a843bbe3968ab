#include "client/agent/sources/csv_session.h"

#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "formats/session_file.h"
#include "formats/text_file.h"

namespace truepose::agent {
namespace {

bool IsBlank(const std::string& text) {
  return text.find_first_not_of(" \t,;\xEF\xBB\xBF") == std::string::npos;
}

// "file:2: q1" and "file: q1" of a header and one row are of the row's line.
std::string Relocated(const std::string& field, const std::string& path, int64_t line) {
  const std::string prefix = path + ":";
  std::string rest = field.rfind(prefix, 0) == 0 ? field.substr(prefix.size()) : " " + field;
  const size_t number = rest.find_first_not_of("0123456789");
  rest.erase(0, number == std::string::npos ? rest.size() : number);
  return absl::StrCat(path, ":", line, rest);
}

}  // namespace

CsvSession::CsvSession(const CsvOptions& options, std::string path, ReadingSink& sink,
                       const Stop& stop, const FaultReport& report)
    : options_(options), path_(path), report_(report), feed_(sink, stop, std::move(path), report) {
  if (options.settle.has_value()) settled_.emplace(*options.settle);
}

absl::Status CsvSession::Take(const TextLine& line) {
  if (line.cut) {
    report_({absl::StrCat(path_, ":", line.number),
             absl::StrCat("a line of more than ", line.text.size(), " bytes"), "a reading"});
    return absl::OkStatus();
  }
  if (IsBlank(line.text) || told_late_) return absl::OkStatus();
  if (header_.empty()) return TakeHeader(line);
  auto file = formats::ParseSessionFile(absl::StrCat(header_, "\n", line.text, "\n"), path_,
                                        options_.nominal, {.euler = options_.euler});
  if (!file.ok()) {
    // A sealed session's faults were told when it was taken.
    if (feed_.was_sealed()) return absl::OkStatus();
    for (const Fault& fault : FaultsOf(file.status()))
      report_({Relocated(fault.field, path_, line.number), fault.found, fault.expected});
    return absl::OkStatus();
  }
  parsed_ = std::move(file->session);
  return TakeReading(std::move(file->readings[0]), line);
}

// A header alone is faulty only by having no rows, which is no fault of a file that grows.
absl::Status CsvSession::TakeHeader(const TextLine& line) {
  const auto file = formats::ParseSessionFile(line.text + "\n", path_, options_.nominal,
                                              {.euler = options_.euler});
  FaultList faults;
  for (const Fault& fault : FaultsOf(file.status())) {
    if (fault.found != "no rows under the header")
      faults.Add(Relocated(fault.field, path_, line.number), fault.found, fault.expected);
  }
  header_ = line.text;
  return faults.ToStatus();
}

absl::Status CsvSession::TakeReading(v1::Reading reading, const TextLine& line) {
  if (settled_.has_value() && !IsSettled(reading, line.number)) return absl::OkStatus();
  if (!feed_.begun()) TRUEPOSE_RETURN_IF_ERROR(Begin(line));
  if (!feed_.was_sealed()) return feed_.Add(std::move(reading), line.number);
  TakeSealed(line);
  return absl::OkStatus();
}

void CsvSession::TakeSealed(const TextLine& line) {
  if (++sealed_rows_ <= feed_.readings_before()) return;
  told_late_ = true;
  report_({absl::StrCat(path_, ":", line.number),
           absl::StrCat("a row more than the ", feed_.readings_before(),
                        " readings of its session, which is sealed: it is not taken, nor are more"),
           "a new file for new readings"});
}

bool CsvSession::IsSettled(const v1::Reading& reading, int64_t line) {
  const std::optional<absl::Time> time = TimeOf(reading);
  if (time.has_value()) return settled_->Add(reading, *time);
  if (feed_.was_sealed()) return false;
  report_({absl::StrCat(path_, ":", line, ": time"), "'" + reading.time() + "'",
           "a time with offset, by which standstills are found"});
  return false;
}

absl::Status CsvSession::Begin(const TextLine& line) {
  SessionStart start{options_.content};
  *start.content.mutable_extra_columns() = parsed_.extra_columns();
  if (start.content.source().empty())
    start.content.set_source(std::string(formats::BaseName(path_)));
  start.key = absl::StrCat(path_, "\n", header_, "\n", line.text);
  return feed_.Begin(start);
}

absl::Status CsvSession::End() {
  if (!feed_.begun() || feed_.was_sealed()) return absl::OkStatus();
  return feed_.Seal();
}

}  // namespace truepose::agent
