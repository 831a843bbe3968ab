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

// All guesses; at least one. @param readings at least one, of one placement and one target.
std::vector<FramePair> StartCandidates(const std::vector<NominalReading>& readings,
                                       const std::optional<Pose>& X_FT);

// The base that fits best with a known target, and the target that fits best with a known base.
Pose BaseFromTool(const std::vector<NominalReading>& readings, const Pose& X_FT);
Pose ToolFromBase(const std::vector<NominalReading>& readings, const Pose& X_MB);

}  // namespace truepose
