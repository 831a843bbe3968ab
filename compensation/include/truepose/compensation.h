// libtruepose_compensation in C++: an owner of the plain C interface, which is the library's only
// one, so that program and library need not come from the same compiler. See compensation_c.h for
// units and rules; all is noexcept.
#ifndef TRUEPOSE_COMPENSATION_H_
#define TRUEPOSE_COMPENSATION_H_

#include <cstdint>
#include <span>
#include <utility>

#include "truepose/compensation_c.h"

namespace truepose {

using Outcome = truepose_outcome;
using Correction = truepose_correction;
using Expectation = truepose_expectation;
using FlangePose = truepose_pose;
using TableInfo = truepose_table_info;

struct LoadResult {
  truepose_load_status status = TRUEPOSE_LOAD_INVALID_ARGUMENT;
  truepose_message message{};

  explicit operator bool() const noexcept { return status == TRUEPOSE_LOAD_OK; }
};

struct FlangeResult {
  Outcome outcome = TRUEPOSE_INVALID_ARGUMENT;
  FlangePose X_BF{};  // only with TRUEPOSE_OK
};

// Movable; empty until a load was right, and then never again but by being moved from. An empty one
// gives TRUEPOSE_INVALID_ARGUMENT. So do joints that are not as many as the robot's.
class Compensation {
 public:
  Compensation() noexcept = default;
  Compensation(Compensation&& other) noexcept
      : handle_(std::exchange(other.handle_, nullptr)), joints_(std::exchange(other.joints_, 0)) {}
  Compensation& operator=(Compensation&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(joints_, other.joints_);
    return *this;
  }
  ~Compensation() { truepose_compensation_free(handle_); }

  // Takes the place of the table before; a refused file leaves it. Loading while others correct
  // needs a lock or a second object of theirs.
  LoadResult Load(const char* path, const Expectation& expectation = {}) noexcept {
    LoadResult result;
    truepose_compensation* loaded = nullptr;
    result.status = truepose_compensation_load(path, &expectation, &loaded, &result.message);
    Take(result, loaded);
    return result;
  }
  LoadResult LoadBytes(std::span<const std::uint8_t> bytes,
                       const Expectation& expectation = {}) noexcept {
    LoadResult result;
    truepose_compensation* loaded = nullptr;
    result.status = truepose_compensation_load_bytes(bytes.data(), bytes.size(), &expectation,
                                                     &loaded, &result.message);
    Take(result, loaded);
    return result;
  }

  explicit operator bool() const noexcept { return handle_ != nullptr; }

  // All zero when empty.
  TableInfo Info() const noexcept {
    TableInfo info{};
    truepose_compensation_info(handle_, &info);
    return info;
  }

  Correction CorrectJoints(std::span<const double> q) const noexcept {
    Correction correction{};
    truepose_compensation_correct_joints(handle_, Checked(q), &correction);
    return correction;
  }
  Correction CorrectJointsExactly(std::span<const double> q) const noexcept {
    Correction correction{};
    truepose_compensation_correct_joints_exactly(handle_, Checked(q), &correction);
    return correction;
  }
  Correction CorrectPose(const FlangePose& X_BF, std::span<const double> q_seed) const noexcept {
    Correction correction{};
    truepose_compensation_correct_pose(handle_, &X_BF, Checked(q_seed), &correction);
    return correction;
  }

  FlangeResult NominalFlange(std::span<const double> q) const noexcept {
    FlangeResult result;
    result.outcome = truepose_compensation_nominal_flange(handle_, Checked(q), &result.X_BF);
    return result;
  }
  FlangeResult IdentifiedFlange(std::span<const double> q) const noexcept {
    FlangeResult result;
    result.outcome = truepose_compensation_identified_flange(handle_, Checked(q), &result.X_BF);
    return result;
  }
  FlangeResult TableFlange(std::span<const double> q) const noexcept {
    FlangeResult result;
    result.outcome = truepose_compensation_table_flange(handle_, Checked(q), &result.X_BF);
    return result;
  }

 private:
  void Take(const LoadResult& result, truepose_compensation* loaded) noexcept {
    if (!result) return;
    truepose_compensation_free(std::exchange(handle_, loaded));
    joints_ = static_cast<std::size_t>(Info().joints);
  }
  const double* Checked(std::span<const double> q) const noexcept {
    return q.size() == joints_ ? q.data() : nullptr;
  }

  truepose_compensation* handle_ = nullptr;
  std::size_t joints_ = 0;
};

}  // namespace truepose

#endif  // TRUEPOSE_COMPENSATION_H_
