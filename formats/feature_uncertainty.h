// How well a fixture's feature is known: `sd_mm`, `sd_deg`, or a covariance of all six.
#pragma once

#include <array>

#include "formats/field_lines.h"
#include "formats/yaml_map.h"
#include "truepose/v1/fixture.pb.h"

namespace truepose::formats {

// Reads the keys into feature->covariance (6 x 6 row by row: position and rotation in axes of M, m
// and rad); none of them leaves it empty. Faults: a deviation below 0, an angle of a feature
// without orientation, both forms at once, not six rows of six.
void ReadUncertainty(YamlMap& map, v1::Feature* feature, FieldLines& lines);

// ", sd_mm: [0.02, 0, 0]" when its squares are the covariance to the bit, else all of it; "" for
// none.
std::string UncertaintyText(const v1::Feature& feature);

}  // namespace truepose::formats
