// Progress of running jobs in a watch: the latest value only, and only when it has changed.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "truepose/v1/watch.pb.h"

namespace truepose::watch {

// What one watcher was told. One call at a time.
class ProgressTeller {
 public:
  using Look = std::function<std::vector<v1::WatchedProgress>()>;

  // `look` tells the progress of all jobs that run now; {} = this watcher asked for none.
  explicit ProgressTeller(Look look) : look_(std::move(look)) {}

  // What differs from the call before.
  std::vector<v1::WatchedProgress> News();

 private:
  const Look look_;
  std::map<std::string, std::string> told_;  // bytes by job
};

}  // namespace truepose::watch
