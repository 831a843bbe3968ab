// Connections that send lines and are answered with lines; one thread for all of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "absl/status/statusor.h"
#include "client/agent/stop.h"

namespace truepose::agent {

// What one connection says. Called in the server's thread.
class LineHandler {
 public:
  virtual ~LineHandler() = default;
  // Lines without their ends, in the order in which they came; the answers with theirs.
  virtual std::string Answer(const std::vector<std::string>& lines) = 0;
  virtual std::string AnswerTooLong(size_t most) = 0;
};

struct LineServerOptions {
  std::string listen = {};  // "127.0.0.1:7900", "[::1]:0"; port 0: any that is free
  std::vector<std::string> allowed_peers = {};  // numeric addresses, besides loopback
  // Bytes. A longer line that begins with { is answered and skipped; any other ends its connection,
  // since it may be of HTTP.
  size_t largest_line = 64 << 10;
  size_t most_connections = 200;
  // Who doesn't read its answers is neither read from nor answered beyond this.
  size_t largest_backlog = 1 << 20;
};

class LineServer {
 public:
  // @param make_handler for each connection. @param metrics text for "GET /metrics", which is
  //   answered as HTTP/1.0; what else looks like HTTP is cut off, since a web page in a browser of
  //   this PC may send such lines.
  // @returns kUnavailable when the address can't be listened at; kInvalidArgument when it is none.
  static absl::StatusOr<std::unique_ptr<LineServer>> Start(
      const LineServerOptions& options, std::function<std::unique_ptr<LineHandler>()> make_handler,
      std::function<std::string()> metrics);
  // Answers what has come, then closes all connections.
  ~LineServer();
  LineServer(const LineServer&) = delete;
  LineServer& operator=(const LineServer&) = delete;

  // With the port that was taken.
  const std::string& address() const { return address_; }

 private:
  class Connection;

  LineServer(const LineServerOptions& options,
             std::function<std::unique_ptr<LineHandler>()> make_handler,
             std::function<std::string()> metrics, int descriptor, std::string address);
  void RunThread();
  void Accept();

  const LineServerOptions options_;
  const std::function<std::unique_ptr<LineHandler>()> make_handler_;
  const std::function<std::string()> metrics_;
  const int descriptor_;
  const std::string address_;
  Stop stop_;
  std::vector<std::unique_ptr<Connection>> connections_;  // of the thread
  std::thread thread_;
};

}  // namespace truepose::agent
