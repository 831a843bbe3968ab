// A client of the agent's TCP interface.
#pragma once

#include <optional>
#include <string>

#include "nlohmann/json.hpp"

namespace truepose::testing {

class LineClient {
 public:
  explicit LineClient(const std::string& address) { Connect(address); }
  ~LineClient() { Close(); }
  LineClient(const LineClient&) = delete;
  LineClient& operator=(const LineClient&) = delete;

  bool connected() const { return descriptor_ >= 0; }
  void Connect(const std::string& address);
  void Close();
  // false: the connection is broken.
  bool Send(const std::string& bytes);
  // The next line; none when the connection ends or nothing comes for half a minute.
  std::optional<std::string> ReadLine();
  // Sends a message and reads its answer.
  std::optional<nlohmann::json> Ask(const nlohmann::json& message);

 private:
  int descriptor_ = -1;
  std::string in_;
};

}  // namespace truepose::testing
