#include "client/agent/lines/line_server.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

#include "absl/strings/match.h"
#include "absl/strings/str_cat.h"
#include "client/agent/lines/socket_address.h"
#include "core/base/status_macros.h"

namespace truepose::agent {
namespace {

constexpr size_t kReadAtOnce = 64 << 10;
// Handed over together: about those of one read, when they are readings. What they are answered
// goes beyond the backlog.
constexpr size_t kLinesAtOnce = 256;

bool LooksLikeHttp(const std::string& line) {
  return absl::StrContains(line, " HTTP/1.") && !line.empty() && line.front() != '{';
}

}  // namespace

class LineServer::Connection {
 public:
  Connection(const LineServer& server, int descriptor, std::unique_ptr<LineHandler> handler)
      : server_(server), descriptor_(descriptor), handler_(std::move(handler)) {}
  ~Connection() { close(descriptor_); }

  pollfd Waited() const {
    const bool reads = !ending_ && !no_more_ && !IsFull();
    return {descriptor_, static_cast<short>((reads ? POLLIN : 0) | (out_.empty() ? 0 : POLLOUT)),
            0};
  }
  void Read();
  // Sends answers, then answers lines that have come as long as there is place for the answers.
  void Work();
  bool has_ended() const { return broken_ || (ending_ && out_.empty()); }

 private:
  bool IsFull() const { return out_.size() > server_.options_.largest_backlog; }
  bool HasLine() const { return in_.find('\n') != std::string::npos; }
  void Write();
  void AnswerSome();
  // Of a line that is too long. One that is no message is taken for HTTP: its connection ends.
  void TakeTooLong(const std::string& begin);
  // Whether the line was one of HTTP, and is dealt with.
  bool TakeHttp(const std::string& line);

  const LineServer& server_;
  const int descriptor_;
  const std::unique_ptr<LineHandler> handler_;
  std::string in_, out_;
  bool skipping_ = false;  // the rest of a line that is too long
  bool no_more_ = false;   // comes from the other side
  bool ending_ = false;    // answers go out, then the connection ends
  bool broken_ = false;
};

void LineServer::Connection::Read() {
  const size_t before = in_.size();
  in_.resize(before + kReadAtOnce);
  const ssize_t got = recv(descriptor_, in_.data() + before, kReadAtOnce, 0);
  in_.resize(before + static_cast<size_t>(std::max<ssize_t>(got, 0)));
  if (got < 0 && errno != EAGAIN && errno != EINTR) broken_ = true;
  if (got == 0) no_more_ = true;
  Work();
}

void LineServer::Connection::Work() {
  Write();
  while (HasLine() && !IsFull() && !ending_ && !broken_) {
    AnswerSome();
    Write();
  }
  if (HasLine()) return;
  if (in_.size() > server_.options_.largest_line) {
    if (!std::exchange(skipping_, true)) TakeTooLong(in_);
    in_.clear();
  }
  if (no_more_) ending_ = true;
  Write();
}

void LineServer::Connection::AnswerSome() {
  std::vector<std::string> lines;
  size_t begin = 0;
  for (size_t end = in_.find('\n'); end != std::string::npos && lines.size() < kLinesAtOnce;
       end = in_.find('\n', begin)) {
    std::string line = in_.substr(begin, end - begin);
    begin = end + 1;
    if (std::exchange(skipping_, false)) continue;
    if (TakeHttp(line)) return;
    if (line.size() > server_.options_.largest_line) {
      // Those before it are answered first.
      out_ += handler_->Answer(std::exchange(lines, {}));
      TakeTooLong(line);
      if (ending_) return;
      continue;
    }
    lines.push_back(std::move(line));
  }
  in_.erase(0, begin);
  if (!lines.empty()) out_ += handler_->Answer(lines);
}

void LineServer::Connection::TakeTooLong(const std::string& begin) {
  out_ += handler_->AnswerTooLong(server_.options_.largest_line);
  if (begin.front() == '{') return;
  in_.clear();
  ending_ = true;
}

bool LineServer::Connection::TakeHttp(const std::string& line) {
  if (!LooksLikeHttp(line)) return false;
  in_.clear();
  ending_ = true;
  if (absl::StartsWith(line, "GET /metrics ")) {
    out_ += absl::StrCat("HTTP/1.0 200 OK\r\nContent-Type: text/plain; version=0.0.4\r\n\r\n",
                         server_.metrics_());
  }
  return true;
}

void LineServer::Connection::Write() {
  while (!out_.empty()) {
    const ssize_t sent = send(descriptor_, out_.data(), out_.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) broken_ = true;
    if (sent <= 0) return;
    out_.erase(0, static_cast<size_t>(sent));
  }
}

absl::StatusOr<std::unique_ptr<LineServer>> LineServer::Start(
    const LineServerOptions& options, std::function<std::unique_ptr<LineHandler>()> make_handler,
    std::function<std::string()> metrics) {
  TRUEPOSE_ASSIGN_OR_RETURN(const int descriptor, ListenAt(options.listen));
  return std::unique_ptr<LineServer>(new LineServer(
      options, std::move(make_handler), std::move(metrics), descriptor, AddressOf(descriptor)));
}

LineServer::LineServer(const LineServerOptions& options,
                       std::function<std::unique_ptr<LineHandler>()> make_handler,
                       std::function<std::string()> metrics, int descriptor, std::string address)
    : options_(options),
      make_handler_(std::move(make_handler)),
      metrics_(std::move(metrics)),
      descriptor_(descriptor),
      address_(std::move(address)) {
  thread_ = std::thread([this] { RunThread(); });
}

LineServer::~LineServer() {
  stop_.Request();
  thread_.join();
  close(descriptor_);
}

void LineServer::Accept() {
  sockaddr_storage peer{};
  socklen_t size = sizeof(peer);
  const int descriptor =
      accept4(descriptor_, reinterpret_cast<sockaddr*>(&peer), &size, SOCK_NONBLOCK | SOCK_CLOEXEC);
  if (descriptor < 0) return;
  const std::string host = HostOf(peer);
  const auto& allowed = options_.allowed_peers;
  const bool may =
      IsLoopback(host) || std::find(allowed.begin(), allowed.end(), host) != allowed.end();
  if (!may || connections_.size() >= options_.most_connections) {
    close(descriptor);
    return;
  }
  const int on = 1;
  setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  connections_.push_back(std::make_unique<Connection>(*this, descriptor, make_handler_()));
}

void LineServer::RunThread() {
  while (!stop_.requested()) {
    std::vector<pollfd> waited = {{stop_.descriptor(), POLLIN, 0}, {descriptor_, POLLIN, 0}};
    for (const auto& connection : connections_) waited.push_back(connection->Waited());
    if (poll(waited.data(), waited.size(), -1) < 0) continue;
    for (size_t i = 2; i < waited.size(); ++i) {
      Connection& connection = *connections_[i - 2];
      if (waited[i].revents & POLLOUT) connection.Work();
      if (waited[i].revents & (POLLIN | POLLHUP | POLLERR)) connection.Read();
    }
    if (waited[1].revents & POLLIN) Accept();
    std::erase_if(connections_, [](const auto& connection) { return connection->has_ended(); });
  }
  connections_.clear();
}

}  // namespace truepose::agent
