// A simulated robot with an instrument as a source: it drives to targets, waits until it stands
// still and measures. For tests and demonstrations; the truth is known (core/simulation/cell.h).
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "client/agent/source.h"
#include "client/agent/sources/settled.h"
#include "core/simulation/cell.h"

namespace truepose::agent {

struct SimulatedOptions {
  std::string robot;                         // robots/{robot}
  std::string label = {};                    // tells sessions of one robot apart, such as "check 1"
  v1::Session content = {};                  // of its sessions; robot is set from above
  std::vector<std::vector<double>> targets;  // controller joints; without them 40 are drawn
  // Simulated seconds for a real one; 0 = as fast as the sink takes readings.
  double speed = 0;
  double move_s = 2.0, still_s = 1.5;  // the way to a target, the time there
  double sample_s = 0.05;              // between two samples of the joints
  double swing = 5e-4;                 // rad or m: how far a joint overshoots as it comes to rest
  SettleOptions settle;
  // Measures whenever a recalibration request is open, until it is stopped; else one session of the
  // targets.
  bool for_requests = false;
  std::chrono::milliseconds poll{200};  // for requests
  uint64_t noise_from = 0;  // reading i has the noise of number noise_from + i (Cell::Measure)
};

// What a robot reads on its way to `to` and there, t_s after it set out: an even start and stop,
// then a swing of 3 Hz that dies away in 0.2 s.
std::vector<double> JointsOnTheWay(const std::vector<double>& from, const std::vector<double>& to,
                                   double t_s, const SimulatedOptions& options);

// The time of the cell goes on from session to session: it begins at 0 with the first Run, or is
// `clock`'s. A session that was begun before goes on behind its last reading.
class SimulatedSource : public Source {
 public:
  // @param clock seconds of the cell's time; {} counts the time that moves take.
  SimulatedSource(std::shared_ptr<const Cell> cell, SimulatedOptions options,
                  std::function<double()> clock = {});

  // "simulated robots/ur10", and the label.
  std::string name() const override;
  absl::Status Run(ReadingSink& sink, const Stop& stop) override;

 private:
  absl::Status MeasureSession(ReadingSink& sink, const Stop& stop, const SessionStart& start,
                              const std::vector<std::vector<double>>& targets);
  absl::Status AnswerRequests(ReadingSink& sink, const Stop& stop);
  // Drives there; @returns what was read once it stood still, kCancelled by a stop.
  absl::StatusOr<v1::Reading> DriveTo(const std::vector<double>& target, uint64_t number,
                                      const Stop& stop);
  v1::Reading ReadingAt(const std::vector<double>& read, const std::vector<double>& target,
                        uint64_t number) const;
  double Now() const { return clock_ ? clock_() : elapsed_s_; }
  absl::Time TimeNow() const;

  const std::shared_ptr<const Cell> cell_;
  const SimulatedOptions options_;
  const std::function<double()> clock_;
  double elapsed_s_ = 0;
  std::vector<double> at_;  // where the robot stands
};

}  // namespace truepose::agent
