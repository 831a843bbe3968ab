// Four threads correct joints by one table at once, each also loading it for itself. Built with the
// thread sanitizer, which ends it with an error on any write that another thread can see; checks
// besides that all get the same joints.
#include <cstdio>
#include <thread>
#include <vector>

#include "compensation/encode_table.h"
#include "tests/compensation/table_samples.h"
#include "truepose/compensation.h"

namespace {

constexpr int kThreads = 4, kTargets = 2000;

// One number for all corrected joints; the same for all threads, to the bit.
double SumOfJoints(const truepose::Compensation& robot) {
  double sum = 0;
  for (int k = 0; k < kTargets; ++k) {
    const double share = static_cast<double>(k) / kTargets;
    const double q[6] = {share, -1.6 + share / 4, 1.4 + share / 4, -1.6 - share / 4, -1.5, -share};
    const truepose::Correction by_table = robot.CorrectJoints(q);
    const truepose::Correction exactly = robot.CorrectJointsExactly(q);
    for (int i = 0; i < 6; ++i) sum += by_table.q[i] + exactly.q[i];
    if (by_table.outcome != TRUEPOSE_OK || exactly.outcome != TRUEPOSE_OK) return -1;
  }
  return sum;
}

}  // namespace

int main() {
  const std::vector<std::byte> bytes =
      truepose::compensation::Encode(truepose::compensation::testing::SmallTable());
  const std::span<const std::uint8_t> span(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                           bytes.size());
  truepose::Compensation shared;
  if (!shared.LoadBytes(span)) return 1;
  std::vector<double> sums(2 * kThreads);
  std::vector<std::thread> threads;
  for (int t = 0; t < kThreads; ++t) {
    threads.emplace_back([&, t] {
      truepose::Compensation own;
      if (own.LoadBytes(span)) sums[2 * t] = SumOfJoints(own);
      sums[2 * t + 1] = SumOfJoints(shared);
    });
  }
  for (std::thread& thread : threads) thread.join();
  const double alone = SumOfJoints(shared);
  for (double sum : sums) {
    if (alone == -1 || sum != alone) {
      std::printf("found %.17g, expected %.17g\n", sum, alone);
      return 1;
    }
  }
  std::printf("%d threads, %d corrections each: the same joints\n", kThreads, 4 * kTargets);
  return 0;
}
