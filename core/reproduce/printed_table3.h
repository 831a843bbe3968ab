// What Table 3 prints.
#pragma once

#include "core/reproduce/table3.h"

namespace truepose {

// Fills the column's printed names, in the table's order from base to gripper; leaves them empty
// for a model that the table does not have.
void FillPrinted(Table3Column* column);

}  // namespace truepose
