#include "client/agent/sources/line_stream.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace truepose::agent {
namespace {

constexpr size_t kBlock = 64 << 10;

}  // namespace

bool LineStream::WouldWait() const {
  if (at_ < block_.size()) return false;
  pollfd waited{descriptor_, POLLIN, 0};
  return poll(&waited, 1, 0) <= 0;
}

// @returns false when there is nothing more to come.
bool LineStream::Fill(const Stop& stop) {
  pollfd waited[] = {{descriptor_, POLLIN, 0}, {stop.descriptor(), POLLIN, 0}};
  while (poll(waited, 2, -1) < 0 && errno == EINTR) {
  }
  if (waited[1].revents != 0) return false;
  block_.resize(kBlock);
  at_ = 0;
  ssize_t n;
  do {
    n = read(descriptor_, block_.data(), block_.size());
  } while (n < 0 && errno == EINTR);
  block_.resize(n > 0 ? static_cast<size_t>(n) : 0);
  ended_ = n == 0 || (n < 0 && errno != EAGAIN);
  return !ended_;
}

std::optional<TextLine> LineStream::Next(const Stop& stop) {
  while (!stop.requested()) {
    const size_t end = std::min(block_.find('\n', at_), block_.size());
    const size_t room = longest_line_ - line_.size();
    cut_ = cut_ || end - at_ > room;
    line_.append(block_, at_, std::min(end - at_, room));
    at_ = std::min(end + 1, block_.size());
    if (end < block_.size()) return TakeLine();
    if (ended_ || !Fill(stop)) break;
  }
  if (!ended_ || line_.empty()) return std::nullopt;
  return TakeLine();
}

TextLine LineStream::TakeLine() {
  if (!line_.empty() && line_.back() == '\r') line_.pop_back();
  return {++lines_, std::exchange(line_, {}), std::exchange(cut_, false)};
}

}  // namespace truepose::agent
