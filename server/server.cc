#include "server/server.h"

#include <filesystem>
#include <utility>
#include <vector>

#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/auth/authenticator.h"
#include "server/auth/bootstrap.h"
#include "server/jobs/engine.h"
#include "server/listen_address.h"
#include "server/rpc/drain.h"
#include "server/rpc/executor.h"
#include "server/rpc/listener.h"
#include "server/rpc/log.h"
#include "server/scheduled_tasks.h"
#include "server/scheduler.h"
#include "server/services/administration.h"
#include "server/services/bindings/bindings.h"
#include "server/services/recalibration_job.h"
#include "server/services/release.h"
#include "server/services/table_jobs.h"
#include "server/store/store.h"
#include "server/time_zone.h"
#include "server/watch/wake_hub.h"

namespace truepose::server {
namespace {

// Calls that may wait for a thread; a client hears of more at once instead of waiting in vain.
constexpr size_t kMostWaitingCalls = 1'000;

std::string ToGrpc(const ListenAddress& address) {
  if (!address.unix_path.empty()) return absl::StrCat("unix:", address.unix_path);
  if (address.host == "::1") return absl::StrCat("[::1]:", address.port);
  return absl::StrCat(address.host == "localhost" ? "127.0.0.1" : address.host, ":", address.port);
}

absl::Status OnEnd(store::Transaction& transaction, const v1::CalibrationJob& job) {
  TRUEPOSE_RETURN_IF_ERROR(services::EndTableJob(transaction, job));
  return services::MoveRequestOfJob(transaction, job);
}

jobs::EngineOptions ToEngineOptions(const ServerOptions& options) {
  jobs::EngineOptions engine;
  engine.workers = options.workers;
  engine.with_result = services::ReleaseWithinLimits;
  engine.on_end = OnEnd;
  return engine;
}

// What the database takes on the disk; the file of its newest commits comes and goes.
int64_t DatabaseBytes(const std::string& database) {
  int64_t bytes = 0;
  for (const char* file : {"", "-wal"}) {
    std::error_code missing;
    const auto size = std::filesystem::file_size(database + file, missing);
    if (!missing) bytes += static_cast<int64_t>(size);
  }
  return bytes;
}

services::ServerFacts FactsOf(const ServerOptions& options, const watch::WakeHub& hub) {
  return {.version = TRUEPOSE_VERSION,
          .start = absl::Now(),
          .time_zone = options.time_zone.empty() ? SystemTimeZone() : options.time_zone,
          .database_bytes = [file = options.database] { return DatabaseBytes(file); },
          .watchers = [&hub] { return hub.count(); }};
}

// Who may call, and from where the first admin comes.
struct Access {
  std::unique_ptr<auth::Authenticator> authenticator;
  std::unique_ptr<auth::Bootstrap> bootstrap;
};

absl::StatusOr<Access> OpenAccess(const ServerOptions& options, store::Store& store) {
  Access access;
  if (options.dev_open) {
    access.authenticator = auth::Authenticator::OpenToAll();
  } else {
    TRUEPOSE_ASSIGN_OR_RETURN(access.authenticator, auth::Authenticator::Load(store));
  }
  const bool wanted = !options.dev_open && (options.bootstrap || !access.authenticator->HasAdmin());
  TRUEPOSE_ASSIGN_OR_RETURN(access.bootstrap,
                            auth::Bootstrap::Begin(options.database + ".bootstrap", wanted));
  return access;
}

}  // namespace

// Members are destroyed in reverse: the listener first, the store last.
struct Server::Parts {
  Parts(const ServerOptions& server_options, std::unique_ptr<store::Store> opened,
        Access opened_access, jobs::Runners runners)
      : options(server_options),
        store(std::move(opened)),
        access(std::move(opened_access)),
        engine(*store, std::move(runners), ToEngineOptions(options), store->clock()),
        scheduler(ScheduledTasks(*store), options.schedule, store->clock(), rpc::LogError),
        handlers(options.handler_threads, kMostWaitingCalls),
        compute(options.compute_threads, kMostWaitingCalls),
        administration{*access.authenticator, *access.bootstrap, FactsOf(options, hub)},
        services(services::BindServices({*store, engine, {}, &administration}, {handlers, compute},
                                        drain, {.hub = hub, .stall = options.watch_stall})) {
    store->OnCommit([this] { hub.Changed(); });
  }
  ~Parts() { store->OnCommit({}); }

  const ServerOptions options;
  const std::unique_ptr<store::Store> store;
  const Access access;
  jobs::JobEngine engine;
  Scheduler scheduler;
  watch::WakeHub hub;
  rpc::Drain drain;
  rpc::Executor handlers, compute;
  services::Administration administration;
  const std::vector<std::unique_ptr<grpc::Service>> services;
  std::unique_ptr<rpc::Listener> listener;
  bool stopped = false;
};

absl::StatusOr<std::unique_ptr<Server>> Server::Start(const ServerOptions& options,
                                                      jobs::Runners runners) {
  TRUEPOSE_RETURN_IF_ERROR(options.Validate());
  TRUEPOSE_ASSIGN_OR_RETURN(const ListenAddress address, ParseListenAddress(options.listen));
  TRUEPOSE_RETURN_IF_ERROR(CheckFree(address));
  TRUEPOSE_ASSIGN_OR_RETURN(auto store,
                            store::Store::Open({.path = options.database, .clock = options.clock}));
  TRUEPOSE_ASSIGN_OR_RETURN(Access access, OpenAccess(options, *store));
  auto parts =
      std::make_unique<Parts>(options, std::move(store), std::move(access), std::move(runners));
  TRUEPOSE_RETURN_IF_ERROR(parts->engine.Start());
  parts->scheduler.Start();
  TRUEPOSE_ASSIGN_OR_RETURN(parts->listener,
                            rpc::Listener::Start(parts->services, ToGrpc(address)));
  return std::unique_ptr<Server>(new Server(std::move(parts)));
}

Server::Server(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}

Server::~Server() { Stop(); }

const std::string& Server::address() const { return parts_->listener->address(); }

std::shared_ptr<grpc::Channel> Server::InProcessChannel(const grpc::ChannelArguments& arguments) {
  return parts_->listener->InProcessChannel(arguments);
}

std::string Server::bootstrap_file() const { return parts_->access.bootstrap->waiting_file(); }

void Server::Stop() {
  if (std::exchange(parts_->stopped, true)) return;
  parts_->listener->StopServing();
  parts_->drain.Begin();
  parts_->listener->Shutdown(parts_->options.drain);
  parts_->scheduler.Stop();
  parts_->engine.Stop();
}

}  // namespace truepose::server
