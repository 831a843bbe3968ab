#include "client/agent/sources/growing_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/cli/temp_folder.h"

namespace truepose::agent {
namespace {

using State = GrowingFile::State;

class GrowingFileTest : public ::testing::Test {
 protected:
  void Append(const std::string& text) const {
    std::ofstream(path_, std::ios::binary | std::ios::app) << text;
  }

  // Reads until there is nothing more: "1:a 2:b" and what ended it.
  std::string All(GrowingFile& file, State* state) const {
    std::string text;
    *state = State::kLines;
    while (*state == State::kLines) {
      std::vector<TextLine> lines;
      *state = file.Read(&lines);
      for (const TextLine& line : lines) {
        text += (text.empty() ? "" : " ") + std::to_string(line.number) + ":" + line.text +
                (line.cut ? "..." : "");
      }
    }
    return text;
  }
  std::string All(GrowingFile& file) { return All(file, &state_); }

  const cli::TempFolder folder_;
  const std::string path_ = folder_.Path("a.csv");
  GrowingFile file_{path_, 10};
  State state_ = State::kEnd;
};

// Would catch half a line that is handed out, and CR that is left.
TEST_F(GrowingFileTest, LinesComeWhenTheyAreWhole) {
  EXPECT_EQ(All(file_), "");
  EXPECT_EQ(state_, State::kMissing);
  Append("one\r\ntw");
  EXPECT_EQ(All(file_), "1:one");
  EXPECT_EQ(state_, State::kEnd);
  Append("o\n\nthree");
  EXPECT_EQ(All(file_), "2:two 3:");
  std::vector<TextLine> rest;
  file_.TakeRest(&rest);
  ASSERT_EQ(rest.size(), 1u);
  EXPECT_EQ(rest[0].text, "three");
  EXPECT_EQ(rest[0].number, 4);
}

// Would catch memory that grows with a file without line ends.
TEST_F(GrowingFileTest, LongLinesAreCut) {
  Append("0123456789\n0123456789a\n" + std::string(300'000, 'x') + "\nshort\n");
  EXPECT_EQ(All(file_), "1:0123456789 2:0123456789... 3:xxxxxxxxxx... 4:short");
}

// Would catch lines of the old file that are lost at a rotation, its last one without an end among
// them.
TEST_F(GrowingFileTest, ARotatedFileIsReadToItsEnd) {
  Append("a\n");
  EXPECT_EQ(All(file_), "1:a");
  Append("b\nc");
  std::filesystem::rename(path_, folder_.Path("a.csv.1"));
  EXPECT_EQ(All(file_), "2:b");
  EXPECT_EQ(state_, State::kEnd) << "no new file yet";
  Append("d\n");
  EXPECT_EQ(All(file_), "3:c");
  EXPECT_EQ(state_, State::kReplaced);
  EXPECT_EQ(All(file_), "1:d");
}

// Would catch a file written anew that is taken for one that grew.
TEST_F(GrowingFileTest, AFileWrittenAnewIsNoticed) {
  Append("a\nb\n");
  EXPECT_EQ(All(file_), "1:a 2:b");
  std::ofstream(path_, std::ios::trunc) << "c\n";
  EXPECT_EQ(All(file_), "");
  EXPECT_EQ(state_, State::kRewritten);
  EXPECT_EQ(All(file_), "1:c");
  // Longer than before by the time we look.
  std::ofstream(path_, std::ios::trunc) << "d\ne\nf\ng\n";
  EXPECT_EQ(All(file_), "");
  EXPECT_EQ(state_, State::kRewritten);
  EXPECT_EQ(All(file_), "1:d 2:e 3:f 4:g");
}

TEST_F(GrowingFileTest, AFolderIsNoFile) {
  GrowingFile folder(folder_.Path("."), 10);
  EXPECT_EQ(All(folder), "");
  EXPECT_EQ(state_, State::kMissing);
}

}  // namespace
}  // namespace truepose::agent
