#include "client/address.h"

#include "client/client.h"
#include "core/base/fault.h"
#include "gtest/gtest.h"

namespace truepose::client {
namespace {

TEST(AddressTest, WhatAServerMayListenAtIsTaken) {
  for (const char* address : {"127.0.0.1:7878", "localhost:1", "calibration.plant:65535",
                              "[::1]:7878", "unix:/run/t.sock", "unix:t.sock"}) {
    EXPECT_TRUE(ValidateAddress(address).ok()) << address;
  }
}

// Would catch a typing error that gRPC would try to resolve for half a minute.
TEST(AddressTest, WhatIsNoAddressIsAFault) {
  for (const char* address :
       {"", "localhost", ":7878", "localhost:", "localhost:x", "localhost:0", "localhost:65536",
        "::1:7878", "http://localhost:7878", "[]:1", "unix:"}) {
    EXPECT_EQ(FaultsOf(ValidateAddress(address)).size(), 1u) << address;
    EXPECT_TRUE(absl::IsInvalidArgument(Client::Connect(address).status())) << address;
  }
}

}  // namespace
}  // namespace truepose::client
