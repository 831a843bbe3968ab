// What a server's threads do to its store: each waits for its own commits or not, and commits are
// shared. Notes what was acknowledged.
#pragma once

#include <array>
#include <string>

#include "server/store/store.h"

namespace truepose::store {

// Kinds of effect, each numbered from 1 by one thread.
enum LoadKind {
  kRows,       // readings by row, waited for
  kMoreRows,   // the same of another session
  kSequences,  // readings of a source, several under way
  kRevisions,  // an instrument that is changed again and again, with an event each
  kLoadKinds,
};
using LoadCounts = std::array<int64_t, kLoadKinds>;

inline constexpr int kLoadBatch = 3;  // readings of one closure

// The robot and sessions that the load writes to. A failure fails the test.
void PrepareLoad(Store& store);
// Writes until the first failure of each kind. @returns what was acknowledged by then, in total.
LoadCounts RunLoad(Store& store);
// What is stored, after checks that it is whole: whole batches with the content that was written,
// an event for each change, and SQLite's own integrity check. A fault fails the test.
LoadCounts CheckLoad(Store& store);

}  // namespace truepose::store
