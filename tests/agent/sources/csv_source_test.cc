#include "client/agent/sources/csv_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <thread>

#include "tests/agent/sources/fake_sink.h"
#include "tests/cli/temp_folder.h"

namespace truepose::agent {
namespace {

using ::testing::HasSubstr;

constexpr char kHeader[] = "q1_rad,q2_rad,x_mm,y_mm,z_mm,note\n";

// Row with that first joint.
std::string Row(const std::string& q) { return q + ",0.5,1,2,3,n\n"; }

class CsvSourceTest : public ::testing::Test {
 protected:
  ~CsvSourceTest() override { StopSource(); }

  CsvSourceOptions Options() const {
    CsvSourceOptions options;
    options.path = path_;
    options.csv.content.set_robot("robots/r");
    options.csv.nominal = TwoJoints();
    options.poll = std::chrono::milliseconds(2);
    return options;
  }

  void StartSource(CsvSourceOptions options) {
    stop_ = std::make_unique<Stop>();
    thread_ = std::thread([this, options = std::move(options)] {
      EXPECT_TRUE(CsvSource(options, faults_.Report()).Run(sink_, *stop_).ok());
    });
  }
  void StopSource() {
    if (!thread_.joinable()) return;
    stop_->Request();
    thread_.join();
  }

  void Append(const std::string& text) const {
    std::ofstream(path_, std::ios::binary | std::ios::app) << text;
  }
  void Replace(const std::string& text) const {
    std::ofstream(folder_.Path("new"), std::ios::binary) << text;
    std::filesystem::rename(folder_.Path("new"), path_);
  }

  bool Has(size_t session, const std::string& joints) {
    return sink_.WaitFor([&](const std::vector<FakeSession>& sessions) {
      return sessions.size() > session && FakeSink::Joints(sessions[session]) == joints;
    });
  }
  // More than `before`; after half a minute, the test goes on without.
  void WaitForFault(const std::string& before = "") const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (faults_.Text() == before && std::chrono::steady_clock::now() < end)
      std::this_thread::yield();
  }
  bool IsSealed(size_t session) {
    return sink_.WaitFor([&](const std::vector<FakeSession>& sessions) {
      return sessions.size() > session && sessions[session].sealed;
    });
  }

  const cli::TempFolder folder_;
  const std::string path_ = folder_.Path("tracker.csv");
  FakeSink sink_;
  Faults faults_;
  std::unique_ptr<Stop> stop_;
  std::thread thread_;
};

// Would catch rows that wait for later ones, units lost, and what the file says of its session.
TEST_F(CsvSourceTest, RowsComeAsTheyAreWritten) {
  StartSource(Options());
  Append(std::string(kHeader) + Row("1"));
  ASSERT_TRUE(Has(0, "1"));
  Append(Row("2").substr(0, 4));
  Append(Row("2").substr(4) + Row("3"));
  ASSERT_TRUE(Has(0, "1 2 3"));
  const FakeSession session = sink_.Sessions()[0];
  EXPECT_EQ(session.content.robot(), "robots/r");
  EXPECT_EQ(session.content.source(), "tracker.csv");
  EXPECT_EQ(session.content.extra_columns(0), "note");
  EXPECT_EQ(session.readings[0].position_m().z(), 0.003);
  EXPECT_EQ(session.readings[0].extra_values(0), "n");
  EXPECT_FALSE(session.sealed);
  EXPECT_EQ(faults_.Text(), "");
}

// Would catch one bad line that ends the source, a wrong line number, and readings behind it with
// gaps in their numbers.
TEST_F(CsvSourceTest, BadLinesAreReportedAndTheRestGoesOn) {
  StartSource(Options());
  Append("\n" + std::string(kHeader) + Row("1") + Row("two") + "1,2\n" + std::string(100'000, '7') +
         "\n\n" + Row("3"));
  ASSERT_TRUE(Has(0, "1 3"));
  StopSource();
  EXPECT_THAT(faults_.Text(), HasSubstr(path_ + ":4: q1_rad: found 'two'"));
  EXPECT_THAT(faults_.Text(), HasSubstr(path_ + ":5: "));
  EXPECT_THAT(faults_.Text(), HasSubstr(path_ + ":6: found a line of more than 65536 bytes"));
}

// Would catch a restart that loses or doubles readings.
TEST_F(CsvSourceTest, ARestartGoesOnInTheSameSession) {
  Append(std::string(kHeader) + Row("1") + Row("x") + Row("2"));
  StartSource(Options());
  ASSERT_TRUE(Has(0, "1 2"));
  StopSource();
  Append(Row("3"));
  StartSource(Options());
  ASSERT_TRUE(Has(0, "1 2 3"));
  EXPECT_EQ(sink_.Sessions().size(), 1u);
}

TEST_F(CsvSourceTest, ARotatedFileIsSealedAndTheNextBegun) {
  Append(std::string(kHeader) + Row("1"));
  StartSource(Options());
  ASSERT_TRUE(Has(0, "1"));
  Append("2,0.5,1,2,3,n");  // no line end
  Replace(std::string(kHeader) + Row("5"));
  ASSERT_TRUE(IsSealed(0));
  ASSERT_TRUE(Has(1, "5"));
  EXPECT_EQ(FakeSink::Joints(sink_.Sessions()[0]), "1 2");
  EXPECT_EQ(faults_.Text(), "");
}

TEST_F(CsvSourceTest, AFileWrittenAnewIsReportedAndReadAnew) {
  Append(std::string(kHeader) + Row("1") + Row("2"));
  StartSource(Options());
  ASSERT_TRUE(Has(0, "1 2"));
  std::ofstream(path_, std::ios::trunc) << kHeader << Row("7");
  ASSERT_TRUE(Has(1, "7"));
  EXPECT_TRUE(IsSealed(0));
  EXPECT_THAT(faults_.Text(), HasSubstr("tracker.csv: found what was read already is gone"));
}

TEST_F(CsvSourceTest, AnIdleFileIsSealed) {
  CsvSourceOptions options = Options();
  options.seal_after = std::chrono::milliseconds(20);
  Append(std::string(kHeader) + Row("1"));
  StartSource(options);
  ASSERT_TRUE(IsSealed(0));
}

// Would catch readings that nobody misses since their file was silent for too long: in the process
// that sealed it and in the next one, which must not tell of the lines that were taken.
TEST_F(CsvSourceTest, LinesAfterTheSealAreReportedOnce) {
  CsvSourceOptions options = Options();
  options.seal_after = std::chrono::milliseconds(20);
  Append(std::string(kHeader) + Row("1") + Row("x"));
  StartSource(options);
  ASSERT_TRUE(IsSealed(0));
  StopSource();
  StartSource(options);
  Replace(std::string(kHeader) + Row("5"));
  ASSERT_TRUE(IsSealed(1));
  const std::string before = faults_.Text();
  EXPECT_EQ(before, path_ + ":3: q1_rad: found 'x', expected a number\n") << "once, not again";
  Append(Row("6") + Row("7"));
  WaitForFault(before);
  StopSource();
  EXPECT_THAT(faults_.Text().substr(before.size()), HasSubstr(path_ + ":3: found a line after"));
  const std::string until = faults_.Text();
  EXPECT_EQ(until.find(":4:"), std::string::npos);
  StartSource(options);
  WaitForFault(until);
  StopSource();
  EXPECT_THAT(faults_.Text().substr(until.size()),
              HasSubstr(path_ + ":3: found a row more than the 1 readings"));
  EXPECT_EQ(faults_.Text().find(":4:"), std::string::npos);
}

// Would catch readings that are dropped while the spool is full.
TEST_F(CsvSourceTest, AFullSpoolIsWaitedOut) {
  int refused = 0;
  sink_.RefuseAppend([&](const auto&) {
    return ++refused < 3 ? absl::ResourceExhaustedError("full") : absl::OkStatus();
  });
  Append(std::string(kHeader) + Row("1") + Row("2"));
  StartSource(Options());
  ASSERT_TRUE(Has(0, "1 2"));
  EXPECT_EQ(faults_.Text(), "");
}

// Would catch a batch that is lost for one reading, and a loop that offers it for ever.
TEST_F(CsvSourceTest, ReadingsThatTheSinkRefusesAreLeftOut) {
  sink_.RefuseAppend([](const std::vector<v1::Reading>& readings) {
    FaultList faults;
    for (size_t i = 0; i < readings.size(); ++i) {
      if (readings[i].joints_measured(0) == 2.0)
        faults.Add("readings[" + std::to_string(i) + "].joints_measured", "2", "at most 1");
    }
    return faults.ToStatus();
  });
  Append(std::string(kHeader) + Row("1") + Row("2") + Row("3"));
  StartSource(Options());
  ASSERT_TRUE(Has(0, "1 3"));
  EXPECT_EQ(faults_.Text(), path_ + ":3: joints_measured: found 2, expected at most 1\n");
}

// Would catch a header nobody can use that ends the source, not only its file.
TEST_F(CsvSourceTest, ABadHeaderEndsItsFileOnly) {
  Append("a,b\n1,2\n");
  StartSource(Options());
  WaitForFault();
  Replace("q1_rad,q2_rad,x_mm,y_mm\n" + std::string("1,2,3,4\n"));
  ASSERT_TRUE(Has(0, "1"));
}

TEST_F(CsvSourceTest, ARefusedSessionIsReported) {
  sink_.RefuseBegin(absl::NotFoundError("no robot of that name"));
  Append(std::string(kHeader) + Row("1") + Row("2"));
  StartSource(Options());
  WaitForFault();
  StopSource();
  EXPECT_THAT(faults_.Text(), HasSubstr("no robot of that name"));
  EXPECT_TRUE(sink_.Sessions().empty());
}

TEST_F(CsvSourceTest, OnlyStandstillsWhenAsked) {
  CsvSourceOptions options = Options();
  options.csv.settle = SettleOptions{.still = std::chrono::seconds(1), .tolerance = 1e-3};
  std::string text = "time,q1_rad,q2_rad,x_mm\n2026-03-14T09:00:00,0,0,1\n";
  for (int t = 0; t < 6; ++t) {
    text += "2026-03-14T09:00:0" + std::to_string(t) + "Z," + (t < 3 ? std::to_string(t) : "9") +
            ",0," + std::to_string(t) + "\n";
  }
  Append(text);
  StartSource(options);
  ASSERT_TRUE(Has(0, "9"));
  StopSource();
  EXPECT_EQ(sink_.Sessions()[0].readings[0].time(), "2026-03-14T09:00:04Z");
  EXPECT_THAT(faults_.Text(), HasSubstr(":2: time: found '2026-03-14T09:00:00'"));
}

}  // namespace
}  // namespace truepose::agent
