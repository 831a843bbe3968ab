#include "programs/dialect.h"

#include <gtest/gtest.h>

namespace truepose::programs {
namespace {

// Would catch an extension that is taken for another dialect, and a folder's dot for an extension.
TEST(DialectTest, IsKnownByTheExtension) {
  EXPECT_EQ(DialectOfFile("a/weld.script"), Dialect::kUrScript);
  EXPECT_EQ(DialectOfFile("WELD.SRC"), Dialect::kKrl);
  EXPECT_EQ(DialectOfFile("weld.dat"), Dialect::kKrl);
  EXPECT_EQ(DialectOfFile("weld.ModX"), Dialect::kRapid);
  for (const char* path : {"weld", "a.src/weld", "weld.txt", "", "weld."})
    EXPECT_EQ(DialectOfFile(path), std::nullopt) << path;
}

TEST(DialectTest, NamesReadBack) {
  for (const Dialect dialect : {Dialect::kUrScript, Dialect::kKrl, Dialect::kRapid})
    EXPECT_EQ(DialectNamed(NameOf(dialect)), dialect);
  EXPECT_EQ(DialectNamed("KRL "), std::nullopt);
}

}  // namespace
}  // namespace truepose::programs
