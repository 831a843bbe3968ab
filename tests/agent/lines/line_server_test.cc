#include "client/agent/lines/line_server.h"

#include <atomic>
#include <thread>

#include "absl/strings/str_cat.h"
#include "client/agent/lines/socket_address.h"
#include "gmock/gmock.h"
#include "tests/agent/testing/line_client.h"

namespace truepose::agent {
namespace {

using truepose::testing::LineClient;

// Says how many lines came at once.
class Echo : public LineHandler {
 public:
  std::string Answer(const std::vector<std::string>& lines) override {
    std::string out;
    for (const std::string& line : lines) absl::StrAppend(&out, "<", line, ">\n");
    return out;
  }
  std::string AnswerTooLong(size_t most) override { return absl::StrCat("over ", most, "\n"); }
};

class LineServerTest : public ::testing::Test {
 protected:
  std::unique_ptr<LineServer> Start(LineServerOptions options = {}) {
    options.listen = "127.0.0.1:0";
    return *LineServer::Start(
        options, [] { return std::make_unique<Echo>(); }, [] { return "figures\n"; });
  }
};

// Would catch lines that are cut or joined where the network cuts them.
TEST_F(LineServerTest, LinesAreWholeHoweverTheyCome) {
  const auto server = Start();
  LineClient client(server->address());
  client.Send("one\ntw");
  EXPECT_EQ(client.ReadLine(), "<one>");
  client.Send("o\nthree\n");
  EXPECT_EQ(client.ReadLine(), "<two>");
  EXPECT_EQ(client.ReadLine(), "<three>");
}

// Would catch a line without end that fills the memory, and one after which nothing is understood.
TEST_F(LineServerTest, ALineThatIsTooLongIsSkipped) {
  const auto server = Start({.largest_line = 100});
  LineClient client(server->address());
  client.Send(absl::StrCat("before\n{", std::string(300'000, 'x'), "\nafter\n"));
  EXPECT_EQ(client.ReadLine(), "<before>");
  EXPECT_EQ(client.ReadLine(), "over 100");
  EXPECT_EQ(client.ReadLine(), "<after>");
  client.Send(absl::StrCat("{", std::string(150, 'y'), "\nlast\n"));
  EXPECT_EQ(client.ReadLine(), "over 100");
  EXPECT_EQ(client.ReadLine(), "<last>");
}

// Would catch a connection that keeps others waiting, and one too many that ends the agent.
TEST_F(LineServerTest, ManyConnections) {
  const auto server = Start({.most_connections = 50});
  std::vector<std::unique_ptr<LineClient>> clients;
  for (int i = 0; i < 50; ++i) clients.push_back(std::make_unique<LineClient>(server->address()));
  for (int i = 0; i < 50; ++i) clients[i]->Send(absl::StrCat("from ", i, "\n"));
  for (int i = 0; i < 50; ++i) EXPECT_EQ(clients[i]->ReadLine(), absl::StrCat("<from ", i, ">"));
  LineClient late(server->address());
  late.Send("hello\n");
  EXPECT_EQ(late.ReadLine(), std::nullopt);
  clients.pop_back();
  // The server sees the end of that connection no later than the next one's begin, but for a
  // moment.
  std::optional<std::string> answer;
  for (int attempt = 0; attempt < 1000 && !answer.has_value(); ++attempt) {
    LineClient next(server->address());
    next.Send("hello\n");
    answer = next.ReadLine();
  }
  EXPECT_EQ(answer, "<hello>");
}

// Would catch a web page that makes the browser of this PC send messages, and figures that a
// Prometheus can't fetch.
TEST_F(LineServerTest, HttpGetsFiguresAndNothingElse) {
  const auto server = Start();
  LineClient metrics(server->address());
  metrics.Send("GET /metrics HTTP/1.1\r\nHost: pc\r\n\r\n");
  EXPECT_EQ(metrics.ReadLine(), "HTTP/1.0 200 OK\r");
  std::string last;
  for (auto line = metrics.ReadLine(); line.has_value(); line = metrics.ReadLine()) last = *line;
  EXPECT_EQ(last, "figures");
  LineClient page(server->address());
  page.Send("POST / HTTP/1.1\r\nHost: pc\r\n\r\n{\"op\":\"decline\"}\n");
  EXPECT_EQ(page.ReadLine(), std::nullopt);
}

// Would catch a web page whose request line is too long to be seen as one of HTTP, and whose body
// is then taken for messages.
TEST_F(LineServerTest, ATooLongLineThatIsNoMessageEndsTheConnection) {
  const auto server = Start({.largest_line = 100});
  LineClient page(server->address());
  page.Send("POST /" + std::string(200, 'a'));
  EXPECT_EQ(page.ReadLine(), "over 100");
  page.Send(std::string(200, 'a') + " HTTP/1.1\r\nHost: pc\r\n\r\n{\"op\":\"decline\"}\n");
  EXPECT_EQ(page.ReadLine(), std::nullopt);
  LineClient whole(server->address());
  whole.Send("first\n" + std::string(200, 'a') + "\n{\"op\":\"decline\"}\n");
  EXPECT_EQ(whole.ReadLine(), "<first>");
  EXPECT_EQ(whole.ReadLine(), "over 100");
  EXPECT_EQ(whole.ReadLine(), std::nullopt);
}

// Answers with much.
class Talker : public LineHandler {
 public:
  explicit Talker(std::atomic<size_t>& answered) : answered_(answered) {}
  std::string Answer(const std::vector<std::string>& lines) override {
    answered_ += lines.size();
    std::string out;
    for (const std::string& line : lines)
      absl::StrAppend(&out, line, std::string(50'000, '.'), "\n");
    return out;
  }
  std::string AnswerTooLong(size_t) override { return "\n"; }

 private:
  std::atomic<size_t>& answered_;
};

// Would catch small messages with large answers that fill the memory while nobody reads them, and
// messages that are forgotten over it.
TEST_F(LineServerTest, WhoDoesNotReadIsNotAnswered) {
  constexpr size_t kLines = 1500;
  std::atomic<size_t> answered = 0;
  const auto server = *LineServer::Start(
      {.listen = "127.0.0.1:0", .largest_backlog = 1000},
      [&] { return std::make_unique<Talker>(answered); }, [] { return ""; });
  LineClient client(server->address());
  std::string lines;
  for (size_t i = 0; i < kLines; ++i) absl::StrAppend(&lines, i, "\n");
  client.Send(lines);
  while (answered == 0) std::this_thread::yield();
  // The server's only thread is done with the first one when it answers another.
  LineClient other(server->address());
  other.Send("x\n");
  EXPECT_TRUE(other.ReadLine().has_value());
  // 75 MB are more than the system takes over for a connection.
  EXPECT_LT(answered, kLines);
  for (size_t i = 0; i < kLines; ++i)
    ASSERT_EQ(client.ReadLine().value_or("none").substr(0, 6),
              (absl::StrCat(i, "......")).substr(0, 6));
}

TEST_F(LineServerTest, AnAddressThatIsTakenOrNone) {
  const auto server = Start();
  EXPECT_TRUE(absl::IsUnavailable(ListenAt(server->address()).status()));
  EXPECT_TRUE(absl::IsInvalidArgument(ListenAt("localhost:80").status()));
  EXPECT_TRUE(absl::IsInvalidArgument(ListenAt("7900").status()));
}

}  // namespace
}  // namespace truepose::agent
