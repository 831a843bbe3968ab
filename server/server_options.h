// What a server is started with.
#pragma once

#include <string>

#include "absl/status/status.h"
#include "absl/time/time.h"
#include "server/store/clock.h"

namespace truepose::server {

struct ServerOptions {
  std::string listen =
      "127.0.0.1:7878";  // loopback host:port (port 0: any that is free), or unix:path
  std::string database = "truepose.db";  // a file, or ":memory:"
  bool dev_open = false;    // asks for no tokens: everybody is the principal local-dev and an admin
  bool bootstrap = false;   // a new secret for a first admin although there is one: all were lost
  std::string time_zone;    // IANA name of the plant's, such as Europe/Berlin; "" = the system's
  int workers = 1;          // calibration jobs that run at once, 1 to 64
  int handler_threads = 8;  // calls that are handled at once; they mostly wait for the store
  int compute_threads = 2;  // evaluations and compensations at once
  absl::Duration drain =
      absl::Seconds(10);  // what calls under way get at the end before they are cut
  absl::Duration watch_stall =
      absl::Seconds(20);  // a watcher that doesn't take a message for so long is cut
  // Between looks for what is due: intervals of policies, requests that expire, old history.
  absl::Duration schedule = absl::Minutes(1);
  const store::Clock* clock = nullptr;  // not owned; nullptr = the system's, others for tests

  // Every fault at once, with the option's name as field.
  absl::Status Validate() const;
};

}  // namespace truepose::server
