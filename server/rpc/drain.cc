#include "server/rpc/drain.h"

#include <utility>

namespace truepose::rpc {
namespace {

absl::Status Stopping() { return absl::UnavailableError("the server is stopping"); }

}  // namespace

void Drain::Add(const std::shared_ptr<Endable>& stream) {
  {
    std::lock_guard lock(mutex_);
    streams_.remove_if([](const std::weak_ptr<Endable>& other) { return other.expired(); });
    if (!begun_) return streams_.push_back(stream);
  }
  stream->End(Stopping());
}

void Drain::Begin() {
  std::list<std::weak_ptr<Endable>> streams;
  {
    std::lock_guard lock(mutex_);
    begun_ = true;
    streams = std::exchange(streams_, {});
  }
  for (const std::weak_ptr<Endable>& stream : streams) {
    if (const auto open = stream.lock()) open->End(Stopping());
  }
}

}  // namespace truepose::rpc
