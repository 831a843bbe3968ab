// Nothing is allocated after loading, on any way through the library: malloc is ours here, counts,
// and is told to fail on the first call behind the load.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "compensation/encode_table.h"
#include "tests/compensation/table_samples.h"
#include "truepose/compensation.h"

namespace {

bool forbidden = false;
long found = 0;

void Count() {
  if (forbidden) ++found;
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* malloc(std::size_t size) {
  Count();
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  Count();
  return __libc_calloc(count, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  Count();
  return __libc_memalign(alignment, size);
}
}

namespace {

// Targets that are corrected, refused for each reason, and left to the slow way.
void UseAll(const truepose::Compensation& robot) {
  std::vector<std::vector<double>> targets(8, {0.1, -1.5, 1.5, -1.6, -1.5, 0.4});
  targets[1][4] = 0;
  targets[2][1] = NAN;
  targets[3][2] = 9;
  targets[4][4] = -1e-3;
  targets[5].pop_back();
  targets[6][4] = 0.05;
  targets[7][2] = 0.01;
  forbidden = true;
  for (const std::vector<double>& q : targets) {
    const truepose::FlangeResult nominal = robot.NominalFlange(q);
    robot.CorrectJoints(q);
    robot.CorrectJointsExactly(q);
    truepose::FlangePose pose = nominal.X_BF;
    robot.CorrectPose(pose, targets[0]);
    pose.p[0] += 3;
    robot.CorrectPose(pose, targets[0]);
    robot.IdentifiedFlange(q);
    robot.TableFlange(q);
    robot.Info();
  }
  forbidden = false;
}

bool AllocatesNothing(truepose::compensation::TableContent content) {
  const std::vector<std::byte> bytes = truepose::compensation::Encode(content);
  truepose::Compensation robot;
  if (!robot.LoadBytes({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}))
    return false;
  found = 0;
  UseAll(robot);
  std::printf("%d joints: %ld allocations\n", content.header.joints, found);
  return found == 0;
}

}  // namespace

int main() {
  namespace testing = truepose::compensation::testing;
  void* volatile counted = nullptr;
  forbidden = true;
  counted = std::malloc(8);
  forbidden = false;
  std::free(counted);
  if (found != 1) return std::puts("allocations are not counted"), 1;
  auto singular = testing::Ur10Content(testing::Ur10Arm(1e-3), {3, 3, 3, 3});
  singular.axis[4].upper = 1;
  testing::FillNodes(&singular);
  auto seven = testing::PlainContent(testing::RandomArm(std::vector<bool>(7, false), 1e-3, 4), 2);
  auto five = testing::PlainContent(testing::RandomArm(std::vector<bool>(5, false), 1e-3, 4), 2);
  const bool ok = AllocatesNothing(singular) && AllocatesNothing(seven) && AllocatesNothing(five);
  return ok ? 0 : 1;
}
