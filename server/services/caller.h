// Who calls, as handlers know it.
#pragma once

#include "server/auth/caller.h"

namespace truepose::services {

using auth::Caller;

}  // namespace truepose::services
