// Ends open streams when the server stops, since a watch may last for days.
#pragma once

#include <list>
#include <memory>
#include <mutex>

#include "absl/status/status.h"

namespace truepose::rpc {

// A stream that can be told to end.
class Endable {
 public:
  virtual ~Endable() = default;
  // Ends the stream with this status; nothing when it has ended. From any thread.
  virtual void End(const absl::Status& status) = 0;
};

class Drain {
 public:
  // A stream that comes after Begin() is ended at once.
  void Add(const std::shared_ptr<Endable>& stream);
  // Ends every stream with kUnavailable, which tells clients to come back.
  void Begin();

 private:
  std::mutex mutex_;
  bool begun_ = false;
  std::list<std::weak_ptr<Endable>> streams_;
};

}  // namespace truepose::rpc
