// trueposed, a network and truepose-agent as processes, and sources that measure.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "client/client.h"
#include "nlohmann/json.hpp"
#include "tests/agent/testing/agent_process.h"
#include "tests/agent/testing/proxy.h"
#include "tests/integration/server_process.h"

namespace truepose::testing {

class Plant {
 public:
  explicit Plant(unsigned seed);
  ~Plant();

  void StartServer();
  void KillServer() { server_->Kill(); }
  // Of what the killed server's disk has.
  void Backup();
  // The killed server's disk gets the copy back.
  void Restore();

  // On any free port, or at `listen`.
  void StartAgent(const std::string& listen = "127.0.0.1:0", int joints = 6);
  const std::string& listen() const { return listen_; }
  AgentProcess& agent() { return *agent_; }
  Proxy& network() { return *network_; }
  // Beside the network.
  client::Client NewClient() const;
  // "" while no agent is ready.
  std::string agent_address() const;

  // Asks the agent for its status until `found` says yes; false after half a minute.
  bool WaitForStatus(const std::function<bool(const nlohmann::json&)>& found) const;
  // Waits until the server has sealed each of the sessions.
  bool WaitUntilSealed(const std::vector<std::string>& ids) const;
  // By row, x of the position in um.
  std::vector<int64_t> Stored(const std::string& id) const;

 private:
  TempDir folder_, copy_;
  std::string listen_;
  std::unique_ptr<ServerProcess> server_;
  std::unique_ptr<Proxy> network_;
  std::unique_ptr<AgentProcess> agent_;
};

// A port of loopback that nobody listens at.
int FreePort();

// Measures `readings` readings into session `id`, numbered, whatever breaks meanwhile, and seals.
// A reading counts when it was answered for. `on_taken` is told after each.
// @returns how many were answered for.
int64_t MeasureThrough(const Plant& plant, const std::string& id, int64_t readings,
                       const std::function<void()>& on_taken);

}  // namespace truepose::testing
