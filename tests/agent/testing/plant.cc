#include "tests/agent/testing/plant.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "client/pager.h"
#include "convert/run.h"
#include "gtest/gtest.h"
#include "tests/agent/testing/line_client.h"
#include "tests/server/testing/examples.h"

namespace truepose::testing {
namespace {

using nlohmann::json;

constexpr char kDatabase[] = "t.db";

void Nap() { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }

json ReadingOf(int64_t number) {
  return {{"op", "reading"},
          {"number", number},
          {"joints", {0, 0.1, 0.2, 0.3, 0.4, 0.5}},
          {"position_m", {1e-6 * static_cast<double>(number), 0, 0}}};
}

// What asks until it is answered with ok, over as many connections as it takes.
class Persistent {
 public:
  Persistent(const Plant& plant, std::string id) : plant_(plant), id_(std::move(id)) {}

  // The readings that the agent has.
  int64_t Begin() {
    return Ask({{"op", "begin"}, {"robot", "arm"}, {"id", id_}}).at("readings").get<int64_t>();
  }
  json Ask(const json& message) {
    while (true) {
      if (!client_.has_value()) Open();
      auto answer = client_.has_value() ? client_->Ask(message) : std::nullopt;
      if (answer.has_value() && answer->at("ok")) return *answer;
      if (!answer.has_value()) client_.reset();
      // A full disk; anything else is this test's fault.
      if (!answer.has_value()) continue;
      EXPECT_EQ(answer->at("code"), "RESOURCE_EXHAUSTED") << *answer;
      Nap();
    }
  }

 private:
  void Open() {
    const std::string address = plant_.agent_address();
    if (address.empty()) return Nap();
    client_.emplace(address);
    if (!client_->connected()) return client_.reset();
    const auto begun = client_->Ask({{"op", "begin"}, {"robot", "arm"}, {"id", id_}});
    if (!begun.has_value()) client_.reset();
  }

  const Plant& plant_;
  const std::string id_;
  std::optional<LineClient> client_;
};

}  // namespace

Plant::Plant(unsigned seed) {
  StartServer();
  EXPECT_TRUE(NewClient().CreateRobot(RobotRequest("arm")).ok());
  network_ = std::make_unique<Proxy>(server_->address().substr(std::string("unix:").size()), seed);
}

// The agent first: its end does not wait for a network.
Plant::~Plant() {
  agent_.reset();
  server_.reset();
}

void Plant::StartServer() {
  server_.reset();
  server_ = std::make_unique<ServerProcess>(
      folder_, std::vector<std::string>{"--database", folder_.File(kDatabase)});
  EXPECT_TRUE(server_->WaitUntilReady()) << server_->Output();
}

void Plant::Backup() {
  for (const std::string suffix : {"", "-wal"}) {
    std::filesystem::remove(copy_.File(kDatabase + suffix));
    if (std::filesystem::exists(folder_.File(kDatabase + suffix)))
      std::filesystem::copy_file(folder_.File(kDatabase + suffix), copy_.File(kDatabase + suffix));
  }
}

void Plant::Restore() {
  for (const std::string suffix : {"", "-wal", "-shm"}) {
    std::filesystem::remove(folder_.File(kDatabase + suffix));
    if (std::filesystem::exists(copy_.File(kDatabase + suffix)))
      std::filesystem::copy_file(copy_.File(kDatabase + suffix), folder_.File(kDatabase + suffix));
  }
}

void Plant::StartAgent(const std::string& listen, int joints) {
  agent_.reset();
  listen_ = listen;
  agent_ = std::make_unique<AgentProcess>(
      folder_, absl::StrCat("agent = \"cell\"\nserver = \"", network_->address(), "\"\nspool = \"",
                            folder_.File("spool"), "\"\nlisten = \"", listen, "\"\n",
                            "[[robot]]\nname = \"arm\"\njoints = ", joints, "\n"));
  EXPECT_TRUE(agent_->WaitUntilReady()) << agent_->Output();
}

client::Client Plant::NewClient() const {
  return *client::Client::Connect(server_->address(), {.call_timeout = std::chrono::seconds(20)});
}

std::string Plant::agent_address() const {
  std::ifstream file(folder_.File("agent.ready"));
  std::string address;
  std::getline(file, address);
  return address;
}

bool Plant::WaitForStatus(const std::function<bool(const json&)>& found) const {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  LineClient client(agent_address());
  while (std::chrono::steady_clock::now() < end) {
    const auto status = client.Ask({{"op", "status"}});
    if (!status.has_value()) return false;
    if (found(*status)) return true;
    Nap();
  }
  return false;
}

bool Plant::WaitUntilSealed(const std::vector<std::string>& ids) const {
  const client::Client client = NewClient();
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(90);
  for (const std::string& id : ids) {
    v1::GetSessionRequest request;
    request.set_name("sessions/" + id);
    while (true) {
      const auto session = client.GetSession(request);
      if (session.ok() && session->state() == v1::SEALED) break;
      if (std::chrono::steady_clock::now() > end) return false;
      Nap();
    }
  }
  return true;
}

std::vector<int64_t> Plant::Stored(const std::string& id) const {
  const client::Client client = NewClient();
  v1::ListReadingsRequest request;
  request.set_session("sessions/" + id);
  std::vector<int64_t> numbers;
  const absl::Status status = client::ForEachPage(
      request, [&](const auto& r) { return client.ListReadings(r); },
      [&](const v1::ListReadingsResponse& page) {
        for (const v1::Reading& reading : page.readings())
          numbers.push_back(std::llround(1e6 * reading.position_m().x()));
        return absl::OkStatus();
      });
  EXPECT_TRUE(status.ok()) << status;
  return numbers;
}

int FreePort() {
  const Proxy taken("", 0);
  return std::stoi(taken.address().substr(taken.address().rfind(':') + 1));
}

int64_t MeasureThrough(const Plant& plant, const std::string& id, int64_t readings,
                       const std::function<void()>& on_taken) {
  Persistent source(plant, id);
  int64_t answered = source.Begin();
  while (answered < readings) {
    answered = source.Ask(ReadingOf(answered + 1)).at("number").get<int64_t>();
    on_taken();
  }
  source.Ask({{"op", "seal"}, {"session", id}, {"readings", readings}});
  return answered;
}

}  // namespace truepose::testing
