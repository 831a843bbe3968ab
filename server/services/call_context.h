// What a handler may use: the store and the job engine, never the transport.
#pragma once

#include "server/jobs/engine.h"
#include "server/store/store.h"

namespace truepose::services {

struct CallContext {
  store::Store& store;
  jobs::JobEngine& engine;
};

}  // namespace truepose::services
