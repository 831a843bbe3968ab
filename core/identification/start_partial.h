// Guesses of one frame, the other known or guessed, from readings that are less than a point:
// distances, single coordinates, contacts with planes, in any mixture, also with a few full points.
#pragma once

#include <vector>

#include "core/identification/start_candidates.h"

namespace truepose {

// Of X_MB for a target position on the flange. Each anchor that was seen often enough is
// trilaterated in B (start_trilateration.h), which makes it a point known in both frames, as a full
// reading's is; each normal makes a direction (start_directions.h). The rotation aligns points and
// directions, the position is linear then. What the readings leave free (turns about a single
// anchor or normal) is arbitrary. Mirror images and signs are all returned. Where there are three
// anchors or more but fewer than three seen often, the position is also trilaterated for each of
// the 24 axis-parallel rotations.
// @param readings not empty. @returns at least one.
std::vector<Pose> BasesFromToolPosition(const std::vector<NominalReading>& readings,
                                        const Eigen::Vector3d& p_FT);

// Of p_FT for a known base: linear for points, coordinates and planes; from distances by
// trilateration from the anchors as seen from the flange.
// @param readings not empty. @returns at least one.
std::vector<Eigen::Vector3d> ToolPositionsFromBase(const std::vector<NominalReading>& readings,
                                                   const Pose& X_MB);

}  // namespace truepose
