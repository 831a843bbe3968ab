#include "compensation/sha256.h"

#include <gtest/gtest.h>

#include <string>

namespace truepose::compensation {
namespace {

std::string Hex(const std::array<std::uint8_t, 32>& digest) {
  std::string text;
  for (std::uint8_t byte : digest) {
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

std::string HexOf(const std::string& text) {
  Sha256 sha;
  sha.Add(std::as_bytes(std::span(text)));
  return Hex(sha.Finish());
}

// The examples of FIPS 180-4: nothing, one block, two blocks, many. A wrong constant, byte order or
// padding fails.
TEST(Sha256, GivesTheStandardsExamples) {
  EXPECT_EQ(HexOf(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(HexOf("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(HexOf("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(HexOf(std::string(1000000, 'a')),
            "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

// Bytes that wait for a whole block must not be lost or taken twice, whatever the pieces.
TEST(Sha256, IsTheSameInPieces) {
  const std::string text(300, 'x');
  for (size_t first = 0; first <= 130; ++first) {
    Sha256 sha;
    const auto bytes = std::as_bytes(std::span(text));
    sha.Add(bytes.first(first));
    sha.Add(bytes.subspan(first, 65));
    sha.Add(bytes.subspan(first + 65));
    EXPECT_EQ(Hex(sha.Finish()), HexOf(text)) << first;
  }
}

// The padding has to make room for the length at every size of the last block.
TEST(Sha256, PadsEverySize) {
  std::string before;
  for (size_t size = 50; size < 130; ++size) {
    const std::string digest = HexOf(std::string(size, 'q'));
    EXPECT_NE(digest, before);
    before = digest;
  }
  EXPECT_EQ(HexOf(std::string(55, 'a')),
            "9f4390f8d30c2dd92ec9f095b65e2b9ae9b0a925a5258e241c9f1e910f734318");
  EXPECT_EQ(HexOf(std::string(56, 'a')),
            "b35439a4ac6f0948b6d6f9e3c6af0f5f590ce20f1bde7090ef7970686ec6738a");
  EXPECT_EQ(HexOf(std::string(64, 'a')),
            "ffe054fe7ae0cb6dc65c3af9b61d5209f439851db43d0ba5997337df154668eb");
}

}  // namespace
}  // namespace truepose::compensation
