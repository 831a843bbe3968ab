#include "client/agent/sources/folder_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>
#include <thread>

#include "tests/agent/sources/fake_sink.h"
#include "tests/cli/temp_folder.h"

namespace truepose::agent {
namespace {

using ::testing::HasSubstr;

class FolderSourceTest : public ::testing::Test {
 protected:
  ~FolderSourceTest() override { StopSource(); }

  void StartSource() {
    FolderSourceOptions options;
    options.path = folder_.Path(".");
    options.csv.content.set_robot("robots/r");
    options.csv.nominal = TwoJoints();
    options.poll = std::chrono::milliseconds(2);
    stop_ = std::make_unique<Stop>();
    thread_ = std::thread([this, options] {
      EXPECT_TRUE(FolderSource(options, faults_.Report()).Run(sink_, *stop_).ok());
    });
  }
  void StopSource() {
    if (!thread_.joinable()) return;
    stop_->Request();
    thread_.join();
  }

  // Whole at once, as writers do it that rename.
  void Put(const std::string& name, const std::string& text) const {
    folder_.Write(".writing", text);
    std::filesystem::rename(folder_.Path(".writing"), folder_.Path(name));
  }

  bool HasSealed(size_t count) {
    return sink_.WaitFor([&](const std::vector<FakeSession>& sessions) {
      size_t sealed = 0;
      for (const FakeSession& session : sessions) sealed += session.sealed;
      return sealed == count;
    });
  }

  const cli::TempFolder folder_;
  FakeSink sink_;
  Faults faults_;
  std::unique_ptr<Stop> stop_;
  std::thread thread_;
};

constexpr char kHeader[] = "q1_rad,q2_rad,x_mm\n";

// Would catch files that are no sessions, hidden ones, a last line without an end that is lost.
TEST_F(FolderSourceTest, EveryFileIsASession) {
  Put("b.csv", std::string(kHeader) + "3,0,1\n4,0,1");
  Put("a.csv", std::string(kHeader) + "1,0,1\n2,0,1\n");
  Put("notes.txt", "q1_rad\n");
  Put(".hidden.csv", std::string(kHeader) + "9,0,1\n");
  StartSource();
  ASSERT_TRUE(HasSealed(2));
  Put("c.csv", std::string(kHeader) + "5,0,1\n");
  ASSERT_TRUE(HasSealed(3));
  StopSource();
  const std::vector<FakeSession> sessions = sink_.Sessions();
  EXPECT_EQ(FakeSink::Joints(sessions[0]), "1 2");
  EXPECT_EQ(FakeSink::Joints(sessions[1]), "3 4");
  EXPECT_EQ(FakeSink::Joints(sessions[2]), "5");
  EXPECT_EQ(sessions[0].content.source(), "a.csv");
  EXPECT_EQ(faults_.Text(), "");
}

// Would catch a restart that makes sessions twice.
TEST_F(FolderSourceTest, ARestartKnowsWhatWasTaken) {
  Put("a.csv", std::string(kHeader) + "1,0,1\n");
  StartSource();
  ASSERT_TRUE(HasSealed(1));
  StopSource();
  Put("b.csv", std::string(kHeader) + "2,0,1\n");
  StartSource();
  ASSERT_TRUE(HasSealed(2));
  EXPECT_EQ(sink_.Sessions().size(), 2u);
}

// Would catch rows that are added to a file when its session is sealed, and that nobody misses.
TEST_F(FolderSourceTest, RowsAddedLaterAreReported) {
  const std::string text = std::string(kHeader) + "1,0,1\nx,0,1\n2,0,1\n";
  Put("a.csv", text);
  StartSource();
  ASSERT_TRUE(HasSealed(1));
  const std::string before = faults_.Text();
  Put("a.csv", text + "3,0,1\n4,0,1\n");
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (faults_.Text() == before && std::chrono::steady_clock::now() < end)
    std::this_thread::yield();
  StopSource();
  EXPECT_THAT(faults_.Text().substr(before.size()),
              HasSubstr("a.csv:5: found a row more than the 2 readings"));
  EXPECT_EQ(faults_.Text().find("a.csv:6"), std::string::npos);
}

// Would catch one bad file that keeps the others waiting, or that is reported every second.
TEST_F(FolderSourceTest, ABadFileIsReportedOnce) {
  Put("a.csv", "what,is,this\n1,2,3\n");
  Put("b.csv", std::string(kHeader) + "1,0,1\nx,0,1\n");
  StartSource();
  ASSERT_TRUE(HasSealed(1));
  Put("c.csv", std::string(kHeader) + "2,0,1\n");
  ASSERT_TRUE(HasSealed(2));
  StopSource();
  const std::string text = faults_.Text();
  EXPECT_THAT(text, HasSubstr("b.csv:3: q1_rad: found 'x'"));
  const size_t first = text.find("a.csv");
  EXPECT_NE(first, std::string::npos);
  EXPECT_EQ(text.find("no column of a joint", text.find("no column of a joint") + 1),
            std::string::npos)
      << text;
}

}  // namespace
}  // namespace truepose::agent
