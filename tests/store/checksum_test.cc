#include "server/store/checksum.h"

#include <gtest/gtest.h>

namespace truepose::store {
namespace {

// Catches another hash or another spelling: FIPS 180-2, appendix B.1.
TEST(Checksum, Sha256OfAbc) {
  EXPECT_EQ(Sha256Hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

// Catches a generator with a fixed seed.
TEST(Checksum, RandomHexDiffers) {
  EXPECT_EQ(RandomHex128().size(), 32u);
  EXPECT_NE(RandomHex128(), RandomHex128());
}

}  // namespace
}  // namespace truepose::store
