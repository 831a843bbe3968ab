// What a handler may use: the store, the job engine and who calls; never the transport.
#pragma once

#include "server/jobs/engine.h"
#include "server/services/caller.h"
#include "server/store/store.h"

namespace truepose::services {

struct CallContext {
  store::Store& store;
  jobs::JobEngine& engine;
  Caller caller = {};
};

}  // namespace truepose::services
