#include "client/cli/interrupt.h"

#include <signal.h>

#include <atomic>

namespace truepose::cli {
namespace {

std::atomic<bool> g_interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set from a signal handler");

void Remember(int) { g_interrupted.store(true); }

}  // namespace

InterruptScope::InterruptScope() {
  g_interrupted.store(false);
  struct sigaction action = {};
  action.sa_handler = Remember;
  action.sa_flags = SA_RESETHAND | SA_RESTART;
  sigaction(SIGINT, &action, nullptr);
}

InterruptScope::~InterruptScope() { signal(SIGINT, SIG_DFL); }

bool InterruptScope::interrupted() const { return g_interrupted.load(); }

}  // namespace truepose::cli
