// Nothing of the runtime allocates: malloc itself is counted, since Eigen calls that and not new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>

#include "compensation/exact.h"
#include "compensation/inverse.h"
#include "compensation/path.h"
#include "tests/compensation/arms.h"
#include "tests/compensation/wrist_arms.h"

namespace {
std::atomic<long> allocations{0};
}  // namespace

#if defined(__SANITIZE_ADDRESS__)
// The sanitizer owns malloc and tells of every call.
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*)(const volatile void*, size_t),
                                                         void (*)(const volatile void*));
namespace {
const int hooks_installed = __sanitizer_install_malloc_and_free_hooks(
    [](const volatile void*, size_t) { ++allocations; }, [](const volatile void*) {});
}  // namespace
#else
// The C library's own names for what is counted here; new and Eigen's aligned malloc come through.
extern "C" void* __libc_malloc(size_t size);
extern "C" void* malloc(size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
#endif

namespace truepose::compensation {
namespace {

template <typename Call>
long AllocationsOf(Call call) {
  const long before = allocations;
  call();
  return allocations - before;
}

TEST(Allocation, TheCountBites) {
  EXPECT_GE(AllocationsOf([] { ::operator delete(::operator new(100)); }), 1);
  EXPECT_GE(AllocationsOf([] { Eigen::VectorXd::Zero(50).eval(); }), 1);
}

// Every way: fast, slow, closed form, Newton, all kinds of arm.
TEST(Allocation, NoneInAnyWay) {
  const JointArray q = {0.3, -1.2, 1.1, -0.7, 1.1, 0.4, 0.2}, singular{};
  for (const truepose::testing::NamedArm& named : truepose::testing::AllArms()) {
    const Pose X = NominalFlange(named.arm, q.data());
    Pose far = X;
    far.p.x() += 9;
    const Pose path[] = {X, X, far};
    JointArray out[3];
    const long counted = AllocationsOf([&] {
      CorrectJoints(named.arm, q.data(), {});
      CorrectJoints(named.arm, singular.data(), {});
      CorrectPose(named.arm, X, singular.data(), {});
      CorrectPose(named.arm, far, q.data(), {});
      CorrectedTip(named.arm, q.data(), X, Eigen::Vector3d::UnitZ());
      AllBranches(named.arm, X, q.data(), {});
      FollowPath(named.arm, path, 3, q.data(), {}, out);
    });
    EXPECT_EQ(counted, 0) << named.name;
  }
}

// The closed form for every types of the first three joints.
TEST(Allocation, NoneInTheClosedForm) {
  const JointArray q = {0.3, -1.2, 1.1, -0.7, 1.1, 0.4};
  Random random(83);
  for (const std::string& types : truepose::testing::AllTypesOfThree()) {
    const Arm arm = truepose::testing::RandomWristArm(types, &random);
    const Pose X = NominalFlange(arm, q.data());
    Branches branches;
    EXPECT_EQ(AllocationsOf([&] { branches = AllBranches(arm, X, q.data(), {}); }), 0) << types;
    EXPECT_TRUE(branches.closed_form) << types;
  }
}

}  // namespace
}  // namespace truepose::compensation
