// The peer: a server that acknowledges each message of AppendReadings at once and keeps nothing.
#pragma once

#include <memory>
#include <string>

namespace truepose::bench {

class GrpcEcho {
 public:
  // On a free loopback port.
  GrpcEcho();
  ~GrpcEcho();
  const std::string& address() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace truepose::bench
