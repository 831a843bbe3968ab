// What a handler may use: the store, the job engine, who calls and the server's administration;
// never the transport.
#pragma once

#include "server/jobs/engine.h"
#include "server/services/caller.h"
#include "server/store/store.h"

namespace truepose::services {

struct Administration;

struct CallContext {
  store::Store& store;
  jobs::JobEngine& engine;
  Caller caller = {};  // of this call: the bindings set it (bindings/admission.h)
  // Of the server. nullptr only where handlers are tested without one.
  Administration* administration = nullptr;
};

}  // namespace truepose::services
