// An accuracy map as a picture: a slice for each height, a colour for each place, a scale in mm.
// Plain SVG 1.1 with everything in it (no script, style sheet or font of its own), so that any
// viewer or word processor shows it.
#pragma once

#include <string>

#include "truepose/v1/accuracy_map.pb.h"

namespace truepose::cli {

// @param title above the slices. Places that are not reached are crossed out in grey.
std::string AccuracySvg(const v1::AccuracyMap& map, const std::string& title);

}  // namespace truepose::cli
