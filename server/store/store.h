// The store of one server: a database, its one writer thread and its readers.
//
// Work is a closure over a Transaction or Snapshot that calls the repositories (robots.h,
// sessions.h, jobs.h, calibrations.h). A closure must be free of side effects outside of the store:
// it may run more than once, on another thread, and only the last run counts. It must not call Read
// or Write itself (kInternal). All functions are safe from any thread.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "absl/status/status.h"
#include "absl/status/statusor.h"
#include "server/store/clock.h"
#include "server/store/transaction.h"

namespace truepose::store {

struct StoreOptions {
  std::string path;                          // a file, or ":memory:"
  const Clock* clock = nullptr;              // not owned, outlives the store; nullptr = RealClock()
  int readers = 4;                           // connections beside the writer; 1 to 64
  int max_group = 256;                       // closures of one commit at most
  sql::Decorator decorate_writer = nullptr;  // around the writing connection, for fault injection

  // Every fault at once, with the option's name as field.
  absl::Status Validate() const;
};

class Store {
 public:
  // Opens or creates the database and brings it up to the newest migration.
  // One server a database: `<path>.lock` is held while the store lives; it contains the process id.
  // @returns kInvalidArgument for options; kNotFound when the directory doesn't exist;
  // kFailedPrecondition when
  //   another process holds the lock, the file is no database, one of another program, one of a
  //   newer version that says it isn't compatible, one with a changed migration, or can't be
  //   written. Each with one fault (field = path). On failure everything is as before: no file is
  //   created or kept.
  static absl::StatusOr<std::unique_ptr<Store>> Open(StoreOptions options);
  // Waits for running closures; writes that are still queued end with kCancelled.
  ~Store();

  // Runs `closure(Transaction&)`, which returns absl::Status or absl::StatusOr<T>, and returns its
  // result after the commit. A closure that fails leaves nothing behind and doesn't disturb others
  // of the same commit. A failed commit runs each closure again, alone.
  template <typename Closure>
  auto Write(Closure closure) -> std::invoke_result_t<Closure&, Transaction&> {
    return Collect<std::invoke_result_t<Closure&, Transaction&>, Transaction>(
        closure, [this](auto run) { return RunWrite(std::move(run)); });
  }

  // The same without waiting: `done` gets the result once, after the commit, in another thread (in
  // this one when the store is closing). It must be brief and must not call Write. Results come in
  // the order of the calls. For closures that publish no event: OnCommit isn't told of them.
  template <typename Closure, typename Done>
  void WriteAsync(Closure closure, Done done) {
    using Result = std::invoke_result_t<Closure&, Transaction&>;
    const auto result = std::make_shared<Result>(absl::UnknownError("not run"));
    RunWriteAsync(
        [closure = std::move(closure), result](Transaction& transaction) mutable {
          *result = closure(transaction);
          return StatusOf(*result);
        },
        [result, done = std::move(done)](const absl::Status& status) mutable {
          if (!status.ok()) return done(Result(status));
          done(std::move(*result));
        });
  }

  // Runs `closure(Snapshot&)` on one consistent state, beside the writer. Sees every write that has
  // returned.
  template <typename Closure>
  auto Read(Closure closure) -> std::invoke_result_t<Closure&, Snapshot&> {
    return Collect<std::invoke_result_t<Closure&, Snapshot&>, Snapshot>(
        closure, [this](auto run) { return RunRead(std::move(run)); });
  }

  // Random, made with the database: tells a client whether revisions of two answers can be
  // compared.
  const std::string& epoch() const;
  // Revision of the last commit.
  absl::StatusOr<int64_t> Revision();
  // `told` is called after each Write that has committed, from the writing thread; it must be
  // quick. One at most: the next replaces it, {} ends it; no call runs or begins after that.
  void OnCommit(std::function<void()> told);
  const Clock& clock() const;

 private:
  struct Parts;
  explicit Store(std::unique_ptr<Parts> parts);

  absl::Status RunWrite(std::function<absl::Status(Transaction&)> closure);
  void RunWriteAsync(std::function<absl::Status(Transaction&)> closure,
                     std::function<void(const absl::Status&)> done);
  absl::Status RunRead(const std::function<absl::Status(Snapshot&)>& closure);

  static const absl::Status& StatusOf(const absl::Status& status) { return status; }
  template <typename T>
  static const absl::Status& StatusOf(const absl::StatusOr<T>& result) {
    return result.status();
  }

  // Lets one entry point serve closures with and without a value.
  template <typename Result, typename Access, typename Closure, typename Run>
  static Result Collect(Closure& closure, Run run) {
    if constexpr (std::is_same_v<Result, absl::Status>) {
      return run([&closure](Access& access) { return closure(access); });
    } else {
      Result result = absl::UnknownError("not run");
      const absl::Status status = run([&](Access& access) {
        result = closure(access);
        return result.status();
      });
      if (!status.ok()) return status;
      return result;
    }
  }

  std::unique_ptr<Parts> parts_;
};

}  // namespace truepose::store
