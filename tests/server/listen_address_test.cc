#include "server/listen_address.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "absl/strings/str_cat.h"
#include "tests/server/testing/expect_status.h"
#include "tests/server/testing/temp_dir.h"

namespace truepose::server {
namespace {

using testing::HasCode;
using testing::HasFaultsAt;
using testing::IsOk;

TEST(ListenAddressTest, LoopbackAndUnixAreTaken) {
  EXPECT_EQ(ParseListenAddress("127.0.0.1:7878")->port, 7878);
  EXPECT_EQ(ParseListenAddress("localhost:0")->host, "localhost");
  EXPECT_EQ(ParseListenAddress("[::1]:80")->host, "::1");
  EXPECT_EQ(ParseListenAddress("127.9.9.9:1")->host, "127.9.9.9");
  EXPECT_EQ(ParseListenAddress("unix:/run/t.sock")->unix_path, "/run/t.sock");
}

// Would catch a plaintext listener that the whole plant can reach, and a refusal that does not say
// why.
TEST(ListenAddressTest, AddressesThatOthersReachAreRefusedWithTheReason) {
  for (const char* address :
       {"0.0.0.0:7878", "192.168.0.4:7878", "[::]:7878", "example.org:80", "127.0.0.1.evil:80"}) {
    const auto refused = ParseListenAddress(address);
    EXPECT_THAT(refused, HasFaultsAt(std::vector<std::string>{"listen"})) << address;
    EXPECT_THAT(std::string(refused.status().message()),
                ::testing::HasSubstr("calls are not encrypted"));
  }
}

TEST(ListenAddressTest, WhatIsNoAddressIsAFault) {
  for (const char* address : {"", ":", ":7878", "127.0.0.1", "127.0.0.1:", "127.0.0.1:x",
                              "127.0.0.1:65536", "127.0.0.1:-1", "unix:"}) {
    EXPECT_THAT(ParseListenAddress(address), HasFaultsAt(std::vector<std::string>{"listen"}))
        << address;
  }
  EXPECT_THAT(ParseListenAddress("unix:/" + std::string(200, 'x')),
              HasFaultsAt(std::vector<std::string>{"listen"}));
}

// A socket that listens at a loopback port of the system's choice while it lives.
class ListeningTcp {
 public:
  ListeningTcp() : fd_(socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    EXPECT_EQ(bind(fd_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(fd_, 1), 0);
    EXPECT_EQ(getsockname(fd_, reinterpret_cast<sockaddr*>(&address), &size), 0);
    port_ = ntohs(address.sin_port);
  }
  ~ListeningTcp() { close(fd_); }
  int port() const { return port_; }

 private:
  const int fd_;
  int port_ = 0;
};

// Would catch a second server that shares the port of the first, so that each gets half of the
// calls.
TEST(ListenAddressTest, APortInUseIsSeen) {
  const ListeningTcp other;
  const auto status = CheckFree({.host = "127.0.0.1", .port = other.port()});
  EXPECT_THAT(status, HasCode(absl::StatusCode::kUnavailable));
  EXPECT_THAT(std::string(status.message()),
              ::testing::HasSubstr(absl::StrCat("127.0.0.1:", other.port(), " in use")));
  EXPECT_THAT(CheckFree({.host = "127.0.0.1", .port = 0}), IsOk());
}

int ListeningUnix(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof(address.sun_path) - 1);
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  EXPECT_EQ(bind(fd, reinterpret_cast<sockaddr*>(&address), sizeof(address)), 0);
  EXPECT_EQ(listen(fd, 1), 0);
  return fd;
}

// Would catch a server that takes the socket of a running one away, or that needs a person to
// remove a dead one's.
TEST(ListenAddressTest, ALivingSocketIsSeenAndADeadOneIsFine) {
  const testing::TempDir folder;
  const std::string path = folder.File("s.sock");
  EXPECT_THAT(CheckFree({.unix_path = path}), IsOk());
  const int fd = ListeningUnix(path);
  EXPECT_THAT(CheckFree({.unix_path = path}), HasCode(absl::StatusCode::kUnavailable));
  close(fd);
  ASSERT_TRUE(std::filesystem::exists(path));
  EXPECT_THAT(CheckFree({.unix_path = path}), IsOk());
}

// Would catch a typing error that costs a file.
TEST(ListenAddressTest, AFileIsNotASocket) {
  const testing::TempDir folder;
  const std::string path = folder.File("readings.csv");
  std::ofstream(path) << "precious";
  EXPECT_THAT(CheckFree({.unix_path = path}), HasCode(absl::StatusCode::kUnavailable));
  EXPECT_TRUE(std::filesystem::exists(path));
  EXPECT_THAT(CheckFree({.unix_path = folder.File("none/s.sock")}),
              HasCode(absl::StatusCode::kUnavailable));
}

}  // namespace
}  // namespace truepose::server
