// Lines of a session file (docs/formats.md) to readings of a session, one at a time.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "client/agent/sources/growing_file.h"
#include "client/agent/sources/session_feed.h"
#include "client/agent/sources/settled.h"
#include "truepose/v1/robot.pb.h"

namespace truepose::agent {

struct CsvOptions {
  v1::Session content;                  // of the sessions that are begun; robot is needed
  v1::Nominal nominal;                  // number and types of the joints; nothing else is used
  std::string euler = {};               // formats::SessionFileOptions::euler
  std::optional<SettleOptions> settle;  // only readings of standstills; needs a column `time`
};

// The header is the first line that is not blank. The session begins with the first reading and is
// named by path, header and that line, so that a file read again is the same session and a new file
// under an old name is a new one. A line that can't be read is reported with its number and left
// out, and so are rows behind those of a session that is sealed, of which the first is reported. A
// cell must not hold a line end.
class CsvSession {
 public:
  // Everything has to outlive it.
  CsvSession(const CsvOptions& options, std::string path, ReadingSink& sink, const Stop& stop,
             const FaultReport& report);

  // @returns what ends the session: a header that can't be used, or what SessionFeed returns.
  absl::Status Take(const TextLine& line);
  absl::Status Flush() { return feed_.Flush(); }
  // No more lines: seals what there is.
  absl::Status End();

  bool begun() const { return feed_.begun(); }

 private:
  absl::Status TakeHeader(const TextLine& line);
  absl::Status TakeReading(v1::Reading reading, const TextLine& line);
  absl::Status Begin(const TextLine& line);
  // A reading of a session that was sealed before.
  void TakeSealed(const TextLine& line);
  bool IsSettled(const v1::Reading& reading, int64_t line);

  const CsvOptions& options_;
  const std::string path_;
  const FaultReport& report_;
  SessionFeed feed_;
  std::optional<Settled> settled_;
  std::string header_;
  int64_t sealed_rows_ = 0;  // readings seen of a sealed session
  bool told_late_ = false;   // of a row behind them
  v1::Session parsed_;       // what the file says of its session
};

}  // namespace truepose::agent
