#include "client/agent/simulated/commanded_source.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <utility>
#include <vector>

#include "absl/strings/numbers.h"
#include "absl/strings/str_cat.h"
#include "absl/strings/str_split.h"
#include "core/base/random.h"

namespace truepose::agent {
namespace {

// So many readings apart, two sessions share no noise.
constexpr uint64_t kNoiseOfASession = 100'000;
constexpr int kMostPoses = 1'000;

// Around the middle of the limits, where the flange is in front of the robot and below it.
std::vector<std::vector<double>> DrawTargets(const Robot& robot, int poses, uint64_t seed) {
  Random random(seed);
  const Eigen::VectorXd middle = robot.MiddleOfLimits();
  std::vector<std::vector<double>> targets(static_cast<size_t>(poses));
  for (std::vector<double>& target : targets) {
    for (int j = 0; j < robot.joint_count(); ++j) {
      const double range = robot.joints()[j].type == JointType::kRevolute ? 1.5 : 0.3;
      target.push_back(random.Uniform(middle(j) - range, middle(j) + range));
    }
  }
  return targets;
}

// Lines of a pipe that stays open though its writers come and go.
class Lines {
 public:
  explicit Lines(const std::string& path)
      : descriptor_(open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {}
  ~Lines() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  bool ok() const { return descriptor_ >= 0; }

  // Waits for what comes; empty at a stop. The last, unfinished line is kept for the next call.
  std::vector<std::string> Wait(const Stop& stop) {
    pollfd waited[] = {{descriptor_, POLLIN, 0}, {stop.descriptor(), POLLIN, 0}};
    poll(waited, 2, -1);
    if (stop.requested()) return {};
    char bytes[4096];
    const ssize_t count = read(descriptor_, bytes, sizeof bytes);
    if (count > 0) begun_.append(bytes, static_cast<size_t>(count));
    std::vector<std::string> lines = absl::StrSplit(begun_, '\n');
    begun_ = std::move(lines.back());
    lines.pop_back();
    return lines;
  }

 private:
  const int descriptor_;
  std::string begun_;
};

}  // namespace

CommandedSource::CommandedSource(std::shared_ptr<const Cell> cell, SimulatedOptions options,
                                 std::string pipe, std::shared_ptr<BumpClock> clock)
    : cell_(std::move(cell)),
      options_(std::move(options)),
      pipe_(std::move(pipe)),
      clock_(std::move(clock)) {}

absl::Status CommandedSource::Run(ReadingSink& sink, const Stop& stop) {
  Lines lines(pipe_);
  if (!lines.ok()) return absl::NotFoundError(absl::StrCat(pipe_, " is no pipe that can be read"));
  absl::Status first;
  while (!stop.requested()) {
    for (const std::string& line : lines.Wait(stop)) first.Update(Do(line, sink, stop));
  }
  return first;
}

absl::Status CommandedSource::Do(const std::string& line, ReadingSink& sink, const Stop& stop) {
  const std::vector<std::string> words = absl::StrSplit(line, ' ', absl::SkipWhitespace());
  if (words.empty()) return absl::OkStatus();
  int poses = words[0] == "check" ? 30 : 60;
  const bool good = words.size() == 1 || (words.size() == 2 && absl::SimpleAtoi(words[1], &poses) &&
                                          poses > 0 && poses <= kMostPoses);
  if (good && words[0] == "calibrate") return Measure(v1::CALIBRATION, poses, sink, stop);
  if (good && words[0] == "check") return Measure(v1::CHECK, poses, sink, stop);
  if (words != std::vector<std::string>{"bump"})
    return absl::InvalidArgumentError(absl::StrCat("found '", line,
                                                   "', expected calibrate [POSES], "
                                                   "check [POSES] or bump"));
  clock_->Bump();
  return absl::OkStatus();
}

absl::Status CommandedSource::Measure(v1::SessionPurpose purpose, int poses, ReadingSink& sink,
                                      const Stop& stop) {
  ++sessions_;
  SimulatedOptions options = options_;
  options.content.set_purpose(purpose);
  options.label = absl::StrCat("session ", sessions_);
  options.noise_from = kNoiseOfASession * static_cast<uint64_t>(sessions_);
  options.targets = DrawTargets(cell_->robot(), poses, static_cast<uint64_t>(sessions_));
  SimulatedSource source(cell_, options, [clock = clock_] { return clock->Now(); });
  return source.Run(sink, stop);
}

}  // namespace truepose::agent
