// The places around the commits of jobs at which EngineOptions::at_point is called, so that tests
// can end the process there. `in_` and `_written` are inside of a transaction, at its begin and
// before its commit; the store may run such a closure again, and then the place is passed again.
#pragma once

#include <array>
#include <string_view>

namespace truepose::jobs {

inline constexpr std::array<std::string_view, 20> kFailpoints = {
    "before_recover",   // Start(): RUNNING jobs of an earlier process
    "recover_written",  //
    "after_recover",    //
    "before_claim",     // a worker knows that a job waits
    "in_claim",         //
    "claim_written",    //
    "after_claim",      //
    "before_load",      // the frozen input
    "in_load",          //
    "after_load",       //
    "before_run",       // the runner
    "in_run",           // each of its reports of progress
    "after_run",        //
    "before_end",       // the result and the final state
    "in_end",           //
    "end_written",      //
    "after_end",        //
    "before_cancel",    // Cancel()
    "cancel_written",   //
    "after_cancel",     //
};

}  // namespace truepose::jobs
