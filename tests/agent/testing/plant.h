// trueposed, a network and truepose-agent as processes, and sources that measure.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "client/client.h"
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

  void StartAgent();
  AgentProcess& agent() { return *agent_; }
  Proxy& network() { return *network_; }
  // Beside the network.
  client::Client NewClient() const;
  // "" while no agent is ready.
  std::string agent_address() const;

  // Waits until the server has sealed each of the sessions.
  bool WaitUntilSealed(const std::vector<std::string>& ids) const;
  // By row, x of the position in um.
  std::vector<int64_t> Stored(const std::string& id) const;

 private:
  TempDir folder_, copy_;
  std::unique_ptr<ServerProcess> server_;
  std::unique_ptr<Proxy> network_;
  std::unique_ptr<AgentProcess> agent_;
};

// Measures `readings` readings into session `id`, numbered, whatever breaks meanwhile, and seals.
// A reading counts when it was answered for. `on_taken` is told after each.
// @returns how many were answered for.
int64_t MeasureThrough(const Plant& plant, const std::string& id, int64_t readings,
                       const std::function<void()>& on_taken);

}  // namespace truepose::testing
