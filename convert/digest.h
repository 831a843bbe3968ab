// SHA-256 over text lines, lower-case hex.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "truepose/v1/calibration.pb.h"

namespace truepose::convert {

std::string Sha256(const std::string& text);

// Lines `session row`, sessions counted from 0 in the order of the job.
std::string RowsDigest(const std::vector<std::pair<int, int>>& session_rows);

// `convention TAG`, `nominal DIGEST`, then `name value` sorted, values as hexfloats.
std::string CalibrationDigest(const std::string& convention, const std::string& nominal_digest,
                              const v1::Calibration& calibration);

}  // namespace truepose::convert
