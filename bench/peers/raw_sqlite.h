// The peer: rows straight into SQLite with the same settings, by one thread without any network.
#pragma once

#include <string>

namespace truepose::bench {

// Inserts `rows` rows of (session, row, 13 doubles) into a new database at `path`, `batch` rows a
// commit. WAL, synchronous = FULL. Ends the process when it can't.
void FillRawSqlite(const std::string& path, int rows, int batch);

}  // namespace truepose::bench
