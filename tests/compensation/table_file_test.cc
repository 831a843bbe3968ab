// Whatever happens to a table's file, it is refused with the reason, or read as it was written.
#include "compensation/table_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "compensation/encode_table.h"
#include "compensation/table_digest.h"
#include "compensation/table_layout.h"
#include "core/base/random.h"
#include "tests/compensation/table_samples.h"

namespace truepose::compensation {
namespace {

using Bytes = std::vector<std::byte>;

TableReport Read(const Bytes& bytes, const TableExpectation& expectation = {}) {
  TableFile file;
  return TableFile::Copy(bytes, expectation, &file);
}

void FixDigest(Bytes* bytes) {
  const Digest digest = DigestOfTable(*bytes);
  std::memcpy(bytes->data() + kDigestAt, digest.data(), digest.size());
}

template <class T>
void Put(size_t at, T value, Bytes* bytes) {
  std::memcpy(bytes->data() + at, &value, sizeof(value));
}

std::string Message(const TableReport& report) { return report.message.data(); }

class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name)
      : path_(std::filesystem::path(::testing::TempDir()) / (name + std::to_string(getpid()))) {}
  ~TemporaryFile() { std::filesystem::remove(path_); }
  void Write(const Bytes& bytes) const {
    std::ofstream(path_, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
  }
  const char* path() const { return path_.c_str(); }

 private:
  std::filesystem::path path_;
};

// Every field: what is read and written again is the same file, and what was set is what is read.
TEST(TableFile, IsReadAsItWasWritten) {
  const TableContent content = testing::SmallTable();
  const Bytes bytes = Encode(content);
  TableFile file;
  ASSERT_TRUE(TableFile::Copy(bytes, {}, &file).ok());
  const Table& table = file.table();
  EXPECT_EQ(table.header.robot.view(), "robots/ur10");
  EXPECT_EQ(table.header.created_us, 1700000000000000);
  EXPECT_EQ(table.header.worst.rotation_rad, 7e-5);
  EXPECT_EQ(table.arm.identified.constant[3].R, content.arm.identified.constant[3].R);
  EXPECT_EQ(table.arm.effects[2].compliance, 6e-6);
  EXPECT_EQ(table.arm.mass[1].centre_B, content.arm.mass[1].centre_B);
  EXPECT_EQ(table.axis[3].weight, content.axis[3].weight);
  EXPECT_TRUE(std::equal(table.nodes.begin(), table.nodes.end(), content.nodes.begin(),
                         content.nodes.end()));
  const TableContent again{
      table.header, table.arm, table.axis, {table.nodes.begin(), table.nodes.end()}};
  EXPECT_EQ(Encode(again), bytes);
}

// The same table without its optional parts, and limits that are infinite.
TEST(TableFile, KeepsInfiniteLimitsAndSlidingJoints) {
  TableContent content = testing::SmallTable();
  content.arm.limits[0] = {};
  content.arm.measuring = true;
  content.arm.nominal.prismatic[4] = content.arm.identified.prismatic[4] = true;
  TableFile file;
  ASSERT_TRUE(TableFile::Copy(Encode(content), {}, &file).ok());
  EXPECT_EQ(file.table().arm.limits[0].upper, INFINITY);
  EXPECT_TRUE(file.table().arm.measuring);
  EXPECT_TRUE(file.table().arm.identified.prismatic[4]);
  EXPECT_FALSE(file.table().arm.identified.prismatic[3]);
}

// One bit, another bit, all bits of a byte, for each byte of the file: none goes unnoticed, not
// even in bytes that nothing reads.
TEST(TableFile, NoticesEveryFlippedByte) {
  Bytes bytes = Encode(testing::SmallTable());
  Random random(3);
  for (size_t i = 0; i < bytes.size(); ++i) {
    for (const unsigned flip : {1u << random.Below(8), 0x80u, 0xffu}) {
      bytes[i] ^= static_cast<std::byte>(flip);
      const TableReport report = Read(bytes);
      EXPECT_FALSE(report.ok()) << "byte " << i << " flipped by " << flip;
      EXPECT_NE(Message(report), "");
      bytes[i] ^= static_cast<std::byte>(flip);
    }
  }
  EXPECT_TRUE(Read(bytes).ok());
}

TEST(TableFile, NoticesSwappedNodes) {
  Bytes bytes = Encode(testing::SmallTable());
  std::swap_ranges(bytes.end() - 48, bytes.end() - 24, bytes.end() - 24);
  EXPECT_EQ(Read(bytes).fault, TableFault::kDamaged);
}

TEST(TableFile, RefusesEveryTruncation) {
  const Bytes bytes = Encode(testing::SmallTable());
  for (size_t size = 0; size < bytes.size(); ++size) {
    const TableReport report = Read(Bytes(bytes.begin(), bytes.begin() + size));
    ASSERT_EQ(report.fault, TableFault::kTruncated) << size << " bytes";
  }
}

TEST(TableFile, RefusesTrailingBytes) {
  Bytes bytes = Encode(testing::SmallTable());
  bytes.push_back({});
  EXPECT_EQ(Read(bytes).fault, TableFault::kTrailingBytes);
  bytes.resize(2 * bytes.size());
  EXPECT_EQ(Read(bytes).fault, TableFault::kTrailingBytes);
}

// A later version may mean something else by the same bytes, whatever its digest says.
TEST(TableFile, RefusesANewerSchema) {
  Bytes bytes = Encode(testing::SmallTable());
  Put(8, std::uint32_t{2}, &bytes);
  EXPECT_EQ(Read(bytes).fault, TableFault::kNewerSchema);
  FixDigest(&bytes);
  EXPECT_EQ(Read(bytes).fault, TableFault::kNewerSchema);
  EXPECT_EQ(Message(Read(bytes)), "schema: found 2, expected at most 1");
  Put(8, std::uint32_t{0}, &bytes);
  FixDigest(&bytes);
  EXPECT_EQ(Read(bytes).fault, TableFault::kInvalidField);
}

TEST(TableFile, RefusesOtherFiles) {
  Bytes text(100000, std::byte{'a'});
  EXPECT_EQ(Read(text).fault, TableFault::kNotATable);
  EXPECT_EQ(Read(Bytes(100000)).fault, TableFault::kNotATable);
}

TEST(TableFile, RefusesAnotherRobotsTable) {
  const TableContent content = testing::SmallTable();
  const Bytes bytes = Encode(content);
  EXPECT_TRUE(
      Read(bytes, {"2016300123", content.header.nominal_digest, content.header.calibration_digest})
          .ok());
  const TableReport other = Read(bytes, {.serial = "2016300124"});
  EXPECT_EQ(other.fault, TableFault::kOtherRobot);
  EXPECT_EQ(Message(other), "serial: found '2016300123', expected '2016300124'");
  EXPECT_EQ(Read(bytes, {.serial = "201630012"}).fault, TableFault::kOtherRobot);
  EXPECT_EQ(Read(bytes, {"", content.header.calibration_digest, {}}).fault,
            TableFault::kOtherNominal);
  EXPECT_EQ(Read(bytes, {"", {}, content.header.nominal_digest}).fault,
            TableFault::kOtherCalibration);
}

// A table that doesn't say whose it is is not taken where one asks.
TEST(TableFile, RefusesATableWithoutSerialWhereOneIsExpected) {
  TableContent content = testing::SmallTable();
  content.header.serial = {};
  EXPECT_TRUE(Read(Encode(content)).ok());
  EXPECT_EQ(Read(Encode(content), {.serial = "1"}).fault, TableFault::kOtherRobot);
}

struct Hostile {
  const char* name;
  void (*change)(TableContent*);
};

const Hostile kHostile[] = {
    {"joints none", [](TableContent* c) { c->header.joints = 0; }},
    {"joints many", [](TableContent* c) { c->header.joints = 13; }},
    {"joints negative", [](TableContent* c) { c->header.joints = -1; }},
    {"masses many", [](TableContent* c) { c->arm.masses = 17; }},
    {"mass on no joint", [](TableContent* c) { c->arm.mass[0].joint = 6; }},
    {"mass negative", [](TableContent* c) { c->arm.mass[0].mass_kg = -1; }},
    {"not a rotation", [](TableContent* c) { c->arm.nominal.constant[2].R(0, 0) += 1e-6; }},
    {"reflection", [](TableContent* c) { c->arm.identified.constant[6].R *= -1; }},
    {"no position", [](TableContent* c) { c->arm.identified.constant[1].p(1) = NAN; }},
    {"chains differ", [](TableContent* c) { c->arm.identified.prismatic[3] = true; }},
    {"joint map singular", [](TableContent* c) { c->arm.joint_scale(1, 1) = 0; }},
    {"joint map no number", [](TableContent* c) { c->arm.joint_scale(2, 1) = NAN; }},
    {"offset infinite", [](TableContent* c) { c->arm.joint_offset(5) = INFINITY; }},
    {"limits crossed",
     [](TableContent* c) {
       c->arm.limits[5] = {1, -1};
     }},
    {"limit no number", [](TableContent* c) { c->arm.limits[0].lower = NAN; }},
    {"effect infinite", [](TableContent* c) { c->arm.effects[5].sine[1] = INFINITY; }},
    {"weight not whole", [](TableContent* c) { c->axis[2].weight[2] = 0.5; }},
    {"weight huge", [](TableContent* c) { c->axis[2].weight[1] = 1e9; }},
    {"weight no number", [](TableContent* c) { c->axis[2].weight[1] = NAN; }},
    {"axes dependent", [](TableContent* c) { c->axis[2] = c->axis[1]; }},
    {"determinant 2", [](TableContent* c) { c->axis[0].weight[0] = 2; }},
    {"range crossed", [](TableContent* c) { c->axis[5].lower = 7; }},
    {"range infinite", [](TableContent* c) { c->axis[5].upper = INFINITY; }},
    {"range empty",
     [](TableContent* c) { c->axis[1].lower = c->axis[1].upper = c->axis[1].margin = 0; }},
    {"range overflows",
     [](TableContent* c) { c->axis[1].lower = -1e308, c->axis[1].upper = 1e308; }},
    {"margin negative", [](TableContent* c) { c->axis[1].margin = -0.01; }},
    {"no nodes", [](TableContent* c) { c->axis[0].nodes = 0; }},
    {"fewer nodes than axes", [](TableContent* c) { c->axis[1].nodes = 3; }},
    {"nodes overflow",
     [](TableContent* c) {
       for (int i = 1; i < 5; ++i) c->axis[i].nodes = 1 << 30;
     }},
    {"node no number", [](TableContent* c) { c->nodes[7] = NAN; }},
    {"node infinite", [](TableContent* c) { c->nodes.back() = INFINITY; }},
    {"worst negative", [](TableContent* c) { c->header.worst.position_m = -1e-9; }},
    {"tolerance no number", [](TableContent* c) { c->header.tolerance.rotation_rad = NAN; }},
    {"share above one", [](TableContent* c) { c->header.near_singular_share = 1.01; }},
    {"length zero", [](TableContent* c) { c->header.characteristic_length_m = 0; }},
    {"singular value no number", [](TableContent* c) { c->header.smallest_singular_value = NAN; }},
};

// Writes without asking, as a hostile program would.
Bytes Forged(const TableContent& content) {
  TableContent whole = testing::SmallTable();
  Bytes bytes = Encode(whole);
  struct Writer {
    std::byte* at;
    void Put(const void* from, size_t size) { std::memcpy(at, from, size), at += size; }
    void U32(const char*, std::uint32_t value) { Put(&value, 4); }
    void I64(const char*, std::int64_t value) { Put(&value, 8); }
    void F64(const char*, double value) { Put(&value, 8); }
    void Flag(const char* name, bool value) { U32(name, value); }
    void Raw(const char*, const Digest& digest) { Put(digest.data(), digest.size()); }
    void Mask(const char* name, const std::array<bool, kMaxJoints>& flags, int) {
      std::uint32_t bits = 0;
      for (int i = 0; i < kMaxJoints; ++i) bits |= flags[i] ? 1u << i : 0;
      U32(name, bits);
    }
    void Name(const char*, const Text& text) {
      std::memcpy(at, text.view().data(), text.view().size());
      at += kNameBytes;
    }
    void Skip(const char*, size_t size) { at += size; }
  };
  Writer writer{bytes.data() + kFieldsAt};
  VisitFields(writer, content.header, content.arm, content.axis);
  std::memcpy(bytes.data() + kNodesAt, content.nodes.data(), content.nodes.size() * sizeof(float));
  FixDigest(&bytes);
  return bytes;
}

// With a right digest, so that nothing but the check of each field stands before them; the same
// content is not written either.
TEST(TableFile, RefusesFieldsThatCannotBe) {
  EXPECT_TRUE(Read(Forged(testing::SmallTable())).ok());
  for (const Hostile& hostile : kHostile) {
    TableContent content = testing::SmallTable();
    hostile.change(&content);
    const TableReport report = Read(Forged(content));
    EXPECT_EQ(report.fault, TableFault::kInvalidField) << hostile.name << ": " << Message(report);
    EXPECT_NE(Message(report), "") << hostile.name;
    EXPECT_TRUE(Encode(content).empty()) << hostile.name;
  }
}

TEST(TableFile, RefusesBytesThatNothingReads) {
  Bytes bytes = Encode(testing::SmallTable());
  for (const size_t at : {kNodesAt - 1, size_t{56 + 191}, size_t{56 + 30}}) {
    Bytes changed = bytes;
    changed[at] = std::byte{1};
    FixDigest(&changed);
    EXPECT_EQ(Read(changed).fault, TableFault::kInvalidField) << at;
  }
}

// Names are as long as there is room for, or the table is not written: a cut one is another's.
TEST(TableFile, IsNotWrittenWithACutName) {
  TableContent content = testing::SmallTable();
  content.header.robot = std::string(kMostTextBytes, 'r');
  EXPECT_TRUE(Read(Encode(content)).ok());
  content.header.robot = std::string(kMostTextBytes + 1, 'r');
  EXPECT_TRUE(Encode(content).empty());
  EXPECT_EQ(Check(content).fault, TableFault::kInvalidField);
  content.header.robot = std::string("a\0b", 3);
  EXPECT_TRUE(Encode(content).empty());
}

// A few bytes at random, digest made right: no crash, no read beyond the file (under the
// sanitizers), and what is accepted gives numbers or a refusal at any joints.
TEST(TableFile, SurvivesRandomFieldsWithARightDigest) {
  const Bytes bytes = Encode(testing::SmallTable());
  Random random(4);
  int accepted = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    Bytes changed = bytes;
    for (std::uint64_t k = 0; k <= random.Below(3); ++k)
      changed[random.Below(bytes.size())] = static_cast<std::byte>(random.Below(256));
    FixDigest(&changed);
    TableFile file;
    if (!TableFile::Copy(changed, {}, &file).ok()) continue;
    ++accepted;
    std::array<double, kMaxJoints> q{};
    for (double& value : q) value = random.Uniform(-3, 3);
    const Lookup found = LookUp(file.table(), q.data(), Reach::kGrid);
    EXPECT_TRUE(found.delta.allFinite());
  }
  EXPECT_GT(accepted, 100) << "or the mutations reach no code behind the checks";
}

TEST(TableFile, IsMappedFromDisk) {
  const TemporaryFile disk("table_file_test");
  const TableContent content = testing::SmallTable();
  disk.Write(Encode(content));
  TableFile file;
  ASSERT_TRUE(TableFile::Map(disk.path(), {}, &file).ok());
  TableFile moved(std::move(file));
  TableFile assigned;
  assigned = std::move(moved);
  EXPECT_EQ(assigned.table().header.serial.view(), "2016300123");
  EXPECT_EQ(assigned.table().nodes.back(), content.nodes.back());
}

// A table that is replaced by renaming stays what it was for those who have it open.
TEST(TableFile, OutlivesItsName) {
  const TemporaryFile disk("table_file_test_gone");
  const TableContent content = testing::SmallTable();
  disk.Write(Encode(content));
  TableFile file;
  ASSERT_TRUE(TableFile::Map(disk.path(), {}, &file).ok());
  std::filesystem::remove(disk.path());
  EXPECT_EQ(file.table().nodes.back(), content.nodes.back());
}

TEST(TableFile, SaysWhyAFileIsNotOpened) {
  TableFile file;
  EXPECT_EQ(TableFile::Map("/nowhere/at/all", {}, &file).fault, TableFault::kNotOpened);
  EXPECT_EQ(TableFile::Map("/", {}, &file).fault, TableFault::kNotOpened);
  EXPECT_EQ(TableFile::Map("/dev/null", {}, &file).fault, TableFault::kNotOpened);
  const TemporaryFile pipe("table_file_test_pipe");
  ASSERT_EQ(mkfifo(pipe.path(), 0600), 0);
  EXPECT_EQ(TableFile::Map(pipe.path(), {}, &file).fault, TableFault::kNotOpened);
  const TemporaryFile empty("table_file_test_empty");
  empty.Write({});
  EXPECT_EQ(TableFile::Map(empty.path(), {}, &file).fault, TableFault::kTruncated);
}

// A refused file leaves the one that is in use alone.
TEST(TableFile, KeepsTheOldTableWhenTheNewOneIsRefused) {
  TableFile file;
  ASSERT_TRUE(TableFile::Copy(Encode(testing::SmallTable()), {}, &file).ok());
  EXPECT_FALSE(TableFile::Copy(Bytes(8000), {}, &file).ok());
  EXPECT_EQ(file.table().header.serial.view(), "2016300123");
}

}  // namespace
}  // namespace truepose::compensation
