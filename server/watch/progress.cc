#include "server/watch/progress.h"

#include <utility>

namespace truepose::watch {

std::vector<v1::WatchedProgress> ProgressTeller::News() {
  std::vector<v1::WatchedProgress> news;
  if (!look_) return news;
  std::map<std::string, std::string> seen;
  for (v1::WatchedProgress& one : look_()) {
    const auto before = told_.find(one.job());
    std::string bytes = one.SerializeAsString();
    const bool is_new = before == told_.end() || before->second != bytes;
    seen[one.job()] = std::move(bytes);
    if (is_new) news.push_back(std::move(one));
  }
  told_ = std::move(seen);  // jobs that have ended are forgotten
  return news;
}

}  // namespace truepose::watch
