// A simulated robot that is told what to do, line by line in a named pipe:
//
//   calibrate [POSES]   measures a session for a calibration; 60 poses
//   check [POSES]       measures a session for a drift check; 30 poses
//   bump                the cell's events happen (CellEvent::at_s = kBumpAt)
//
// Other lines are reported and ignored. Recalibration requests are answered by a SimulatedSource of
// the same cell beside it.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "client/agent/simulated/simulated_source.h"

namespace truepose::agent {

// When, in the cell's seconds, what `bump` means happens.
inline constexpr double kBumpAt = 1.0;

// The cell's time: 0, and kBumpAt from Bump() on.
class BumpClock {
 public:
  void Bump() { bumped_ = true; }
  double Now() const { return bumped_ ? kBumpAt : 0.0; }

 private:
  std::atomic<bool> bumped_{false};
};

class CommandedSource : public Source {
 public:
  // @param options of its sessions; targets, label, purpose and noise are set for each.
  // @param pipe path of a named pipe that is there.
  CommandedSource(std::shared_ptr<const Cell> cell, SimulatedOptions options, std::string pipe,
                  std::shared_ptr<BumpClock> clock);

  std::string name() const override { return "commands of " + pipe_; }
  absl::Status Run(ReadingSink& sink, const Stop& stop) override;

 private:
  absl::Status Do(const std::string& line, ReadingSink& sink, const Stop& stop);
  absl::Status Measure(v1::SessionPurpose purpose, int poses, ReadingSink& sink, const Stop& stop);

  const std::shared_ptr<const Cell> cell_;
  const SimulatedOptions options_;
  const std::string pipe_;
  const std::shared_ptr<BumpClock> clock_;
  int sessions_ = 0;
};

}  // namespace truepose::agent
