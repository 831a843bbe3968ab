// docs/formats.md describes the file of a table byte by byte; here its rows are held against the
// one description that writer and reader share.
#include "compensation/table_layout.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>

#include "compensation/table_fields.h"

namespace truepose::compensation {
namespace {

// Where each field stands, of an arm that uses every place.
class FieldLister {
 public:
  template <class T>
  void U32(const char* name, const T&) {
    Add(name, 4);
  }
  void U64(const char* name, std::uint64_t) { Add(name, 8); }
  void I64(const char* name, std::int64_t) { Add(name, 8); }
  void F64(const char* name, double) { Add(name, 8); }
  void Flag(const char* name, bool) { Add(name, 4); }
  template <std::size_t n>
  void Raw(const char* name, const std::array<std::uint8_t, n>&) {
    Add(name, n);
  }
  template <std::size_t n>
  void Mask(const char* name, const std::array<bool, n>&, int) {
    Add(name, 4);
  }
  void Name(const char* name, const Text&) { Add(name, kNameBytes); }
  void Skip(const char* name, std::size_t bytes) { Add(name, bytes); }

  // Offset to name.
  std::map<std::size_t, std::string> fields;
  std::size_t end = 0;

 private:
  void Add(const char* name, std::size_t bytes) {
    fields[end] = name;
    end += bytes;
  }
};

FieldLister ListAll() {
  FieldLister list;
  TablePrologue prologue;
  VisitPrologue(list, prologue);
  TableHeader header;
  header.joints = kMaxJoints;
  Arm arm;
  arm.masses = kMaxMasses;
  std::array<TableAxis, kMaxJoints> axes;
  VisitFields(list, header, arm, axes);
  return list;
}

struct Row {
  std::size_t offset, bytes;
  std::vector<std::string> names;
};

// "| 824 | 13 x 96 | `R`, `p` | ..."
std::vector<Row> RowsOfThePage() {
  static const std::regex row(R"(^\| (\d+) \| (\d+)(?: x (\d+))? \| (`[^|]*`) \|.*)");
  static const std::regex name("`([^`]*)`");
  std::vector<Row> rows;
  std::ifstream page(TRUEPOSE_SOURCE_DIR "/docs/formats.md");
  for (std::string line; std::getline(page, line);) {
    std::smatch found;
    if (!std::regex_match(line, found, row)) continue;
    const std::size_t times = found[3].matched ? std::stoul(found[3]) : 1;
    rows.push_back({std::stoul(found[1]), std::stoul(found[2]) * times, {}});
    const std::string names = found[4];
    for (std::sregex_iterator at(names.begin(), names.end(), name), end; at != end; ++at)
      rows.back().names.push_back((*at)[1]);
  }
  return rows;
}

// No byte is left out or told twice, and each row names the fields that stand there, in order.
TEST(TableLayout, IsAsThePageSays) {
  const FieldLister list = ListAll();
  std::size_t at = 0;
  for (const Row& row : RowsOfThePage()) {
    ASSERT_EQ(row.offset, at) << row.names[0];
    std::vector<std::string> found;
    for (auto field = list.fields.lower_bound(at); field != list.fields.lower_bound(at + row.bytes);
         ++field) {
      const bool told = field->second == "reserved" ||
                        std::find(found.begin(), found.end(), field->second) != found.end();
      if (!told) found.push_back(field->second);
    }
    EXPECT_EQ(found, row.names) << "at " << at;
    at += row.bytes;
  }
  EXPECT_EQ(at, kNodesAt);
  EXPECT_EQ(list.end, kNodesAt);
}

// What the page says of the first bytes, of where the digest stands, and of alignment.
TEST(TableLayout, BeginsAsThePageSays) {
  EXPECT_EQ(kDigestAt, 24u);
  EXPECT_EQ(kFieldsAt, 56u);
  EXPECT_EQ(kNodesAt % 64, 0u) << "nodes begin a cache line";
  const std::array<std::uint8_t, 8> magic = {0x89, 0x54, 0x50, 0x43, 0x0d, 0x0a, 0x1a, 0x0a};
  EXPECT_EQ(kTableMagic, magic);
}

// An arm of fewer joints leaves places unused, and moves no field behind them.
TEST(TableLayout, IsTheSameForAnyArm) {
  std::array<std::byte, kNodesAt> bytes;
  for (int joints = 1; joints <= kMaxJoints; ++joints) {
    FieldWriter writer(bytes.data());
    TablePrologue prologue;
    VisitPrologue(writer, prologue);
    TableHeader header;
    header.joints = joints;
    const Arm arm;
    const std::array<TableAxis, kMaxJoints> axes;
    VisitFields(writer, header, arm, axes);
    EXPECT_EQ(writer.at(), bytes.data() + kNodesAt) << joints;
  }
}

}  // namespace
}  // namespace truepose::compensation
