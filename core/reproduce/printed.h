// What the chapter prints in Tables 4 to 8, to be read beside our own figures. Millimetres, as
// there. Its readings are not published and its robot is another one, so no figure of ours has to
// equal these.
//
// To be read with care: the maximum of the complete set differs from the larger of the two others
// in four rows (Table 5 amoeba 40 and 60, Table 6 linear 40 and 60), and a larger set's minimum is
// above a smaller one's on the same readings (amoeba 81: 0.316 with 25 parameters, 0.294 with 14),
// so those fits had not converged.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace truepose {

struct PrintedErrors {
  double mean_mm = 0, sd_mm = 0, max_mm = 0;
};

struct PrintedRow {
  int table = 0;          // 4: before; 5: 25 parameters; 6: the 14; 7: the 14 and selected ones
  std::string algorithm;  // "amoeba", "kalman", "linear"; "" in Table 4
  std::string time;       // on a Pentium of 100 MHz, as printed
  int calibration_poses = 0;
  PrintedErrors calibration;
  std::optional<PrintedErrors> control;  // none for 81 poses
  PrintedErrors complete;
};

// Tables 4 to 7 in their order, 30 rows.
const std::vector<PrintedRow>& PrintedRows();

// A row of Table 8: what was added to the 14 of Eq. 38.
struct PrintedSelection {
  std::string algorithm;
  int calibration_poses = 0;
  std::vector<std::string> added;  // names as in measuring_robot.h
};
const std::vector<PrintedSelection>& PrintedSelections();

// The repeatability of Sec. 11.3: difference of two operators, and d-bar + 3 sigma.
struct PrintedRepeatability {
  double mean_mm = 0.082, sd_mm = 0.062, max_mm = 0.176, mean_plus_3_sd_mm = 0.268;
};

}  // namespace truepose
