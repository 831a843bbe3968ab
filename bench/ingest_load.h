// Clients that send readings on bidirectional streams and wait for every acknowledgement.
#pragma once

#include <string>

namespace truepose::bench {

struct Load {
  int clients = 1;   // each with a connection, a source and a session of its own
  int messages = 1;  // of each client
  int batch = 1;     // readings a message
  int window = 1;    // messages that a client sends before it waits for an acknowledgement
};

// "sessions/" and the UUID of client i's session, which has to exist.
std::string SessionOf(int client);

// Returns when all is acknowledged. Ends the process when a stream fails or an acknowledgement
// doesn't cover what was sent.
void Send(const std::string& address, const Load& load);

}  // namespace truepose::bench
