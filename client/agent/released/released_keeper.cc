#include "client/agent/released/released_keeper.h"

#include <algorithm>

#include "absl/strings/str_cat.h"
#include "client/download.h"
#include "client/watch.h"

namespace truepose::agent {
namespace {

// Of a download that broke; it goes on where it stopped, and the end of the thread waits for it.
constexpr std::chrono::milliseconds kPatience{5'000};

using Log = std::function<void(const std::string&)>;

Log Naming(const std::string& robot, Log log) {
  if (log == nullptr) return nullptr;
  return [robot, log = std::move(log)](const std::string& line) {
    log(absl::StrCat(robot, ": ", line));
  };
}

}  // namespace

ReleasedKeeper::ReleasedKeeper(const client::Client& client, Disk& disk,
                               ReleasedKeeperOptions options,
                               std::function<void(const std::string&)> log,
                               std::function<void(const std::string&)> warn)
    : client_(client),
      options_(std::move(options)),
      store_(ReleasedCache(options_.folder, options_.robot, disk),
             Naming(options_.robot, std::move(log)), Naming(options_.robot, std::move(warn))) {
  thread_ = std::thread([this] { RunThread(); });
}

ReleasedKeeper::~ReleasedKeeper() {
  stop_.Request();
  thread_.join();
}

bool ReleasedKeeper::Offer(const ReleasedEntry& released) {
  const absl::Status status = store_.Offer(released, [&] {
    return client::Download(client_, released.table,
                            {.patience = kPatience, .sha256 = released.sha256});
  });
  if (!status.ok() && !IsForGood(status)) return ++failed_, false;
  failed_ = 0;
  return true;
}

bool ReleasedKeeper::Take(const v1::WatchResponse& response) {
  if (!view_.Take(response)) return !stop_.requested();
  const auto released = view_.Released();
  if (released.has_value()) return Offer(*released) && !stop_.requested();
  if (view_.HasFailed()) {
    store_.SetProblem(view_.WhyNone());
  } else {
    store_.SetWaiting(view_.WhyNone());
  }
  return !stop_.requested();
}

// A watch that is left for a failed download begins with a snapshot, which offers the table again.
void ReleasedKeeper::RunThread() {
  store_.Load();
  client::FollowOptions follow;
  follow.is_cancelled = [this] { return stop_.requested(); };
  follow.on_reconnect = [this](const absl::Status&) { view_.OnBreak(); };
  while (!stop_.requested()) {
    view_ = {};
    client::FollowWatch(
        client_, ServerView::RequestOf(options_.robot),
        [this](const v1::WatchResponse& response) { return Take(response); }, follow)
        .IgnoreError();
    stop_.WaitFor(std::min(options_.longest_pause, options_.pause * (1 << std::min(failed_, 10))));
  }
}

}  // namespace truepose::agent
