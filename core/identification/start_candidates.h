// Guesses of base and tool for the readings of one placement and one target.
#pragma once

#include <optional>
#include <vector>

#include "core/identification/problem.h"

namespace truepose {

struct FramePair {
  Pose X_MB, X_FT;
};

// A reading with what the nominal robot says of it.
struct NominalReading {
  const Reading* reading;
  Pose X_BF;
};

// Whether a reading shows where the target is in all three coordinates.
bool ShowsPoint(const Reading& reading);

// All guesses; at least one. @param readings at least one, of one placement and one target, all of
// which show a point.
std::vector<FramePair> StartCandidates(const std::vector<NominalReading>& readings,
                                       const std::optional<Pose>& X_FT);

// The base that fits best with a known target, and the target that fits best with a known base, of
// readings that show a point.
Pose BaseFromTool(const std::vector<NominalReading>& readings, const Pose& X_FT);
Pose ToolFromBase(const std::vector<NominalReading>& readings, const Pose& X_MB);

// Target orientation by averaging over the readings that show one; identity when none does.
Eigen::Matrix3d AverageToolRotation(const std::vector<NominalReading>& readings,
                                    const Eigen::Matrix3d& R_MB);

// The 24 rotations that carry axes to axes.
std::vector<Eigen::Matrix3d> CubeRotations();

// Targets sit within some tenths of a metre of the flange.
std::vector<Eigen::Vector3d> ToolPositions();

}  // namespace truepose
