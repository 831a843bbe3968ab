// Every example of docs/formats.md does what the page says of it. A fenced block's first line tells
// its kind:
//   ```yaml robot              a robot file
//   ```csv session RRRRRR      a session of a robot with these joint types; a third word is the
//   Euler convention
//   ```csv targets RRRRRR      targets
//   ```csv session-fault RR    a session whose faults are the next block, ```text faults
//   ```yaml robot-fault        the same for a robot file
//   ```yaml fixture, fixture-fault   the same for a fixture
#include <set>

#include "absl/strings/str_join.h"
#include "absl/strings/str_split.h"
#include "formats/fixture_file.h"
#include "formats/robot_file.h"
#include "formats/session_file.h"
#include "formats/targets_file.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/formats/samples.h"

namespace truepose::formats {
namespace {

struct Block {
  std::vector<std::string> words;  // behind the three backquotes
  std::string text;
};

std::vector<Block> Blocks() {
  std::vector<Block> blocks;
  bool inside = false;
  const std::vector<std::string> lines =
      absl::StrSplit(TextOf(TRUEPOSE_SOURCE_DIR "/docs/formats.md"), '\n');
  for (const std::string& line : lines) {
    if (line.rfind("```", 0) == 0) {
      inside = !inside;
      if (inside) blocks.push_back({absl::StrSplit(line.substr(3), ' '), ""});
    } else if (inside) {
      blocks.back().text += line + "\n";
    }
  }
  return blocks;
}

std::string FaultText(const std::vector<std::string>& faults) {
  return absl::StrJoin(faults, "\n") + "\n";
}

// The faults of a block, under the name that the page uses.
std::vector<std::string> FaultsOfBlock(const Block& block) {
  const std::string& kind = block.words.at(1);
  if (kind.rfind("robot", 0) == 0) return Faults(ParseRobotFile(block.text, "robot.yaml"));
  if (kind.rfind("fixture", 0) == 0) return Faults(ParseFixtureFile(block.text, "fixture.yaml"));
  const v1::Nominal robot = RobotOf(block.words.at(2));
  if (kind == "targets") return Faults(ParseTargetsFile(block.text, "targets.csv", robot));
  const std::string euler = block.words.size() > 3 ? block.words[3] : "";
  return Faults(ParseSessionFile(block.text, "session.csv", robot, {euler}));
}

// Catches: an example that a reader copies and that is refused; a message that the program words
// otherwise.
TEST(DocsTest, ExamplesDoWhatThePageSays) {
  const std::vector<Block> blocks = Blocks();
  std::multiset<std::string> kinds;
  for (size_t i = 0; i < blocks.size(); ++i) {
    if (blocks[i].words.size() < 2) continue;
    const std::string& kind = blocks[i].words[1];
    if (kind == "faults") continue;
    kinds.insert(kind);
    if (kind.ends_with("-fault")) {
      ASSERT_LT(i + 1, blocks.size());
      EXPECT_EQ(FaultText(FaultsOfBlock(blocks[i])), blocks[i + 1].text);
    } else {
      EXPECT_EQ(FaultText(FaultsOfBlock(blocks[i])), "\n") << blocks[i].text;
    }
  }
  EXPECT_GE(kinds.count("robot"), 3);
  EXPECT_GE(kinds.count("session"), 11);
  EXPECT_GE(kinds.count("fixture"), 2);
  EXPECT_GE(kinds.count("fixture-fault"), 1);
  EXPECT_GE(kinds.count("targets"), 2);
  EXPECT_GE(kinds.count("session-fault"), 1);
  EXPECT_GE(kinds.count("robot-fault"), 1);
}

}  // namespace
}  // namespace truepose::formats
