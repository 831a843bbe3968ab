// A server within the benchmark, on a port and in a folder of its own.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "server/calibration_runner.h"
#include "server/server.h"

namespace truepose::bench {

// A benchmark that fails has no figure: the message, and the end.
template <typename T>
T Demand(absl::StatusOr<T> value) {
  if (value.ok()) return *std::move(value);
  std::fprintf(stderr, "%s\n", value.status().ToString().c_str());
  std::exit(1);
}

// Goes with the object.
class Folder {
 public:
  Folder() : path_((std::filesystem::temp_directory_path() / "truepose-bench.XXXXXX").string()) {
    if (mkdtemp(path_.data()) == nullptr) std::exit(1);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string File(const char* name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

inline std::unique_ptr<server::Server> StartServer(const Folder& folder) {
  server::ServerOptions options;
  options.dev_open = true;
  options.listen = "127.0.0.1:0";
  options.database = folder.File("truepose.db");
  return Demand(server::Server::Start(options, server::CalibrationRunner()));
}

}  // namespace truepose::bench
