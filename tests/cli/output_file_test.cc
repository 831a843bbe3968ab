#include "client/cli/output_file.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/base/fault.h"
#include "tests/cli/temp_folder.h"

namespace truepose::cli {
namespace {

// Would catch a file that is not written, or a temporary that stays.
TEST(OutputFile, PutsTheWholeTextInPlace) {
  const TempFolder folder;
  folder.Write("a", "old");
  auto file = OutputFile::Create(folder.Path("a"), "--output");
  ASSERT_TRUE(file.ok()) << file.status();
  EXPECT_EQ(folder.Read("a"), "old");
  ASSERT_TRUE(file->Commit("new").ok());
  EXPECT_EQ(folder.Read("a"), "new");
  EXPECT_EQ(folder.FileCount(), 1);
}

// Would catch a failed run that ruins an older result.
TEST(OutputFile, WithoutCommitLeavesEverythingAsItWas) {
  const TempFolder folder;
  folder.Write("a", "old");
  { ASSERT_TRUE(OutputFile::Create(folder.Path("a"), "--output").ok()); }
  EXPECT_EQ(folder.Read("a"), "old");
  EXPECT_EQ(folder.FileCount(), 1);
}

// Would catch a bad place that is only noticed after the work, or not named by its option.
TEST(OutputFile, TellsABadPlaceAtOnce) {
  const TempFolder folder;
  for (const std::string& path : {folder.Path("none/a"), folder.Path("")}) {
    const auto file = OutputFile::Create(path, "--output");
    ASSERT_EQ(FaultsOf(file.status()).size(), 1u) << path;
    EXPECT_EQ(FaultsOf(file.status())[0].field, "--output");
  }
  EXPECT_EQ(folder.FileCount(), 0);
}

// Would catch a device replaced by a file.
TEST(OutputFile, WritesThroughToADevice) {
  auto file = OutputFile::Create("/dev/null", "--output");
  ASSERT_TRUE(file.ok());
  EXPECT_TRUE(file->Commit("text").ok());
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

// Would catch a full disk taken for a success.
TEST(OutputFile, ReportsAFullDevice) {
  auto file = OutputFile::Create("/dev/full", "--output");
  ASSERT_TRUE(file.ok());
  EXPECT_EQ(FaultsOf(file->Commit("text")).size(), 1u);
}

}  // namespace
}  // namespace truepose::cli
