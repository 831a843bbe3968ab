#include "core/reproduce/printed_table3.h"

namespace truepose {

void FillPrinted(Table3Column* column) {
  if (column->model == "extended_dh") {
    column->printed_names = {"dtheta0", "dl0",    "dphi0",   "dbeta0",  // Base 0
                             "dq1",     "dh1",    "dl1",     "dphi1",   // 1
                             "dq2",     "dh2",    "dl2",     "dphi2",   // 2
                             "dq3",     "dphi3",  "dbeta3",             // 3, h3 redundant
                             "dq4",     "dl4",    "dphi4",              // 4, h4 redundant
                             "dq5",     "dh5",    "dl5",     "dphi5",   // 5
                             "dq6",     "dbeta6", "dalpha6", "dc6",    "db6", "da6"};
    column->printed_base = {"dtheta0", "dl0", "dphi0", "dbeta0", "dh1", "dq1"};
    column->printed_gripper = {"dq6", "dbeta6", "dalpha6", "dc6", "db6", "da6"};
  } else if (column->model == "incremental") {
    column->printed_names = {"dalpha0", "dbeta0", "da0",     "db0",  //
                             "dalpha1", "dbeta1", "da1",     "db1",  //
                             "dalpha2", "dbeta2",                    //
                             "dalpha3", "dbeta3", "da3",     "db3",  //
                             "dalpha4", "dbeta4", "da4",     "db4",  //
                             "dalpha5", "dbeta5", "da5",     "db5",  //
                             "dgamma6", "dbeta6", "dalpha6", "dc6", "db6", "da6"};
    column->printed_base = {"dalpha0", "dbeta0", "da0", "db0", "db1", "dbeta1"};
    column->printed_gripper = {"dgamma6", "dbeta6", "dalpha6", "dc6", "db6", "da6"};
  } else if (column->model == "modified_incremental") {
    column->printed_names = {"dalpha0", "dbeta0",  "da0",     "db0",         //
                             "dq1",     "dalpha1", "da1",     "db1",         //
                             "dq2",     "dalpha2",                           //
                             "dq3",     "dalpha3", "dbeta3",  "da3", "db3",  //
                             "dq4",     "dalpha4", "da4",                    //
                             "dq5",     "dalpha5", "da5",     "db5",         //
                             "dq6",     "dbeta6",  "dalpha6", "dc6", "db6", "da6"};
    column->printed_base = {"dalpha0", "dbeta0", "da0", "db0", "db1", "dq1"};
    column->printed_gripper = {"dq6", "dbeta6", "dalpha6", "dc6", "db6", "da6"};
  }
}

}  // namespace truepose
