#include "formats/text_file.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "core/base/fault.h"
#include "gtest/gtest.h"

namespace truepose::formats {
namespace {

// A file of one test, gone with it.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text)
      : path_(testing::TempDir() + "truepose_text_" + std::to_string(getpid())) {
    std::ofstream(path_, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

TEST(TextFileTest, ReadsEveryByte) {
  const std::string text(200000, 'x');
  const TemporaryFile file(text);
  EXPECT_EQ(ReadTextFile(file.path(), text.size()).value_or(""), text);
}

// Catches: a file larger than the memory that is read to its end.
TEST(TextFileTest, StopsAtTheLimit) {
  const TemporaryFile file("12345");
  EXPECT_EQ(ReadTextFile(file.path(), 4).status().code(), absl::StatusCode::kInvalidArgument);
}

TEST(TextFileTest, NamesAMissingFileAndAFolder) {
  const absl::Status missing = ReadTextFile("no/such.csv", 10).status();
  EXPECT_EQ(missing.code(), absl::StatusCode::kNotFound);
  EXPECT_EQ(missing.message(), "no/such.csv: found no such file, expected a readable file");
  const absl::Status folder = ReadTextFile(testing::TempDir(), 10).status();
  EXPECT_EQ(folder.code(), absl::StatusCode::kInvalidArgument);
  ASSERT_EQ(FaultsOf(folder).size(), 1);
  EXPECT_EQ(FaultsOf(folder)[0].found, "a folder");
}

// Catches: overlong forms, surrogates, code points beyond the last, cut characters, NUL.
TEST(TextFileTest, FindsTheFirstByteThatIsNoUtf8) {
  constexpr size_t kNone = std::string_view::npos;
  for (const char* good :
       {"", "abc", "\xC3\xBC", "\xE2\x82\xAC", "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF"}) {
    EXPECT_EQ(FindNotUtf8(good), kNone) << good;
  }
  for (const char* bad : {"\x80", "\xC3", "\xC0\xAF", "\xE0\x80\x80", "\xED\xA0\x80", "\xE2\x82",
                          "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "\xF8\x88\x80\x80\x80", "\xFF"}) {
    EXPECT_EQ(FindNotUtf8(std::string("ab") + bad), 2);
  }
  EXPECT_EQ(FindNotUtf8(std::string_view("a\0b", 3)), 1);
}

TEST(TextFileTest, TakesTheLastComponentOfAPath) {
  EXPECT_EQ(BaseName("a/b.csv"), "b.csv");
  EXPECT_EQ(BaseName("b.csv"), "b.csv");
}

}  // namespace
}  // namespace truepose::formats
