#include "server/store/store.h"

#include <mutex>
#include <utility>

#include "absl/strings/str_cat.h"
#include "core/base/fault.h"
#include "core/base/status_macros.h"
#include "server/store/checksum.h"
#include "server/store/database_file.h"
#include "server/store/lock_file.h"
#include "server/store/migrations.h"
#include "server/store/reader_pool.h"
#include "server/store/sql/query.h"
#include "server/store/sql/sqlite.h"
#include "server/store/sql/transaction.h"
#include "server/store/writer.h"

namespace truepose::store {
namespace {

constexpr char kMemory[] = ":memory:";
constexpr int kMostRuns = 5;

// Whether this thread is inside of a closure: another one would wait for itself.
thread_local bool in_closure = false;

class ClosureScope {
 public:
  ClosureScope() { in_closure = true; }
  ~ClosureScope() { in_closure = false; }
};

absl::Status NestedError() {
  return absl::InternalError("a store closure must not call Read or Write");
}

void CheckRange(FaultList& faults, const char* field, int value, int low, int high) {
  if (value >= low && value <= high) return;
  faults.Add(field, absl::StrCat(value), absl::StrCat(low, " to ", high));
}

// The row that says which database this is; absent only before the first opening has ended.
absl::StatusOr<std::string> EnsureEpoch(sql::Connection& connection) {
  TRUEPOSE_ASSIGN_OR_RETURN(sql::Transaction transaction,
                            sql::Transaction::Begin(connection, sql::Access::kWrite));
  TRUEPOSE_RETURN_IF_ERROR(sql::Run(
      connection,
      "INSERT INTO store (id, epoch, revision) VALUES (1, $1, 0) ON CONFLICT (id) DO NOTHING",
      RandomHex128()));
  std::string epoch;
  {
    TRUEPOSE_ASSIGN_OR_RETURN(auto row,
                              sql::Query(connection, "SELECT epoch FROM store WHERE id = 1"));
    TRUEPOSE_RETURN_IF_ERROR(row->Step().status());
    epoch = row->Text(0);
  }
  TRUEPOSE_RETURN_IF_ERROR(transaction.Commit());
  return epoch;
}

// In a transaction of its own, so that all statements of a closure see one state.
absl::Status ReadOn(sql::Connection& connection,
                    const std::function<absl::Status(Snapshot&)>& closure) {
  absl::Status status;
  for (int run = 0; run < kMostRuns; ++run) {
    TRUEPOSE_ASSIGN_OR_RETURN(const sql::Transaction transaction,
                              sql::Transaction::Begin(connection, sql::Access::kRead));
    Snapshot snapshot(connection);
    const ClosureScope scope;
    status = closure(snapshot);
    if (!sql::IsRetryable(status)) break;
  }
  return status;
}

}  // namespace

absl::Status StoreOptions::Validate() const {
  FaultList faults;
  if (path.empty()) faults.Add("path", "nothing", "a file, or :memory:");
  CheckRange(faults, "readers", readers, 1, 64);
  CheckRange(faults, "max_group", max_group, 1, 100000);
  return faults.ToStatus();
}

// Destroyed from the last to the first: connections, then files, then the lock.
struct Store::Parts {
  const Clock* clock = nullptr;
  // nullptr in memory.
  std::unique_ptr<LockFile> lock;
  std::unique_ptr<NewDatabase> new_database;
  std::string epoch;
  // Only while opening.
  std::unique_ptr<sql::Connection> connection;
  std::unique_ptr<Writer> writer;
  // nullptr in memory, where all share the writer's connection.
  std::unique_ptr<ReaderPool> readers;
  std::mutex told_mutex;
  std::function<void()> told;

  void TellCommit() {
    const std::lock_guard lock(told_mutex);
    if (told) told();
  }
};

namespace {

absl::Status PrepareFiles(StoreOptions& options, std::unique_ptr<LockFile>& lock,
                          std::unique_ptr<NewDatabase>& new_database) {
  if (options.path == kMemory) return absl::OkStatus();
  TRUEPOSE_ASSIGN_OR_RETURN(options.path, ResolveDatabasePath(options.path));
  TRUEPOSE_RETURN_IF_ERROR(CheckDatabaseFile(options.path));
  TRUEPOSE_ASSIGN_OR_RETURN(lock, LockFile::Acquire(options.path + ".lock", options.path));
  new_database = std::make_unique<NewDatabase>(options.path);
  return absl::OkStatus();
}

}  // namespace

absl::StatusOr<std::unique_ptr<Store>> Store::Open(StoreOptions options) {
  TRUEPOSE_RETURN_IF_ERROR(options.Validate());
  auto parts = std::make_unique<Parts>();
  parts->clock = options.clock != nullptr ? options.clock : &RealClock();
  TRUEPOSE_RETURN_IF_ERROR(PrepareFiles(options, parts->lock, parts->new_database));
  TRUEPOSE_ASSIGN_OR_RETURN(parts->connection, sql::OpenSqlite(options.path, sql::Access::kWrite));
  if (options.decorate_writer)
    parts->connection = options.decorate_writer(std::move(parts->connection));
  TRUEPOSE_RETURN_IF_ERROR(
      Migrate(*parts->connection, EmbeddedMigrations(), *parts->clock, options.path));
  TRUEPOSE_ASSIGN_OR_RETURN(parts->epoch, EnsureEpoch(*parts->connection));
  if (parts->new_database != nullptr) {
    parts->new_database->Keep();
    parts->readers = std::make_unique<ReaderPool>(options.path, options.readers);
  }
  parts->writer =
      std::make_unique<Writer>(std::move(parts->connection), *parts->clock, options.max_group);
  return std::unique_ptr<Store>(new Store(std::move(parts)));
}

Store::Store(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Store::~Store() = default;

absl::Status Store::RunWrite(std::function<absl::Status(Transaction&)> closure) {
  if (in_closure) return NestedError();
  const absl::Status status =
      parts_->writer->Write([closure = std::move(closure)](Transaction& transaction) {
        const ClosureScope scope;
        return closure(transaction);
      });
  if (status.ok()) parts_->TellCommit();
  return status;
}

void Store::OnCommit(std::function<void()> told) {
  const std::lock_guard lock(parts_->told_mutex);
  parts_->told = std::move(told);
}

void Store::RunWriteAsync(std::function<absl::Status(Transaction&)> closure,
                          std::function<void(const absl::Status&)> done) {
  if (in_closure) return done(NestedError());
  parts_->writer->Submit(
      [closure = std::move(closure)](Transaction& transaction) {
        const ClosureScope scope;
        return closure(transaction);
      },
      std::move(done));
}

absl::Status Store::RunRead(const std::function<absl::Status(Snapshot&)>& closure) {
  if (in_closure) return NestedError();
  const auto read = [&closure](sql::Connection& connection) { return ReadOn(connection, closure); };
  return parts_->readers != nullptr ? parts_->readers->WithConnection(read)
                                    : parts_->writer->WithConnection(read);
}

const std::string& Store::epoch() const { return parts_->epoch; }

absl::StatusOr<int64_t> Store::Revision() {
  return Read([](Snapshot& snapshot) {
    return sql::QueryInt64(snapshot.sql(), "SELECT revision FROM store WHERE id = 1");
  });
}

const Clock& Store::clock() const { return *parts_->clock; }

}  // namespace truepose::store
