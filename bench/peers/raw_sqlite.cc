#include "bench/peers/raw_sqlite.h"

#include <sqlite3.h>

#include <array>
#include <cstdio>
#include <cstdlib>

namespace truepose::bench {
namespace {

void Must(int code, sqlite3* database) {
  if (code == SQLITE_OK || code == SQLITE_DONE) return;
  std::fprintf(stderr, "raw SQLite: %s\n", sqlite3_errmsg(database));
  std::exit(1);
}

void Execute(sqlite3* database, const char* sql) {
  Must(sqlite3_exec(database, sql, nullptr, nullptr, nullptr), database);
}

sqlite3_stmt* Prepare(sqlite3* database, const char* sql) {
  sqlite3_stmt* statement = nullptr;
  Must(sqlite3_prepare_v2(database, sql, -1, &statement, nullptr), database);
  return statement;
}

void Step(sqlite3* database, sqlite3_stmt* statement) {
  Must(sqlite3_step(statement), database);
  sqlite3_reset(statement);
}

void Insert(sqlite3* database, sqlite3_stmt* insert, int row) {
  std::array<double, 13> values;
  values.fill(0.001 * row);
  sqlite3_bind_int(insert, 1, row);
  sqlite3_bind_blob(insert, 2, values.data(), sizeof(values), SQLITE_STATIC);
  Step(database, insert);
}

}  // namespace

void FillRawSqlite(const std::string& path, int rows, int batch) {
  sqlite3* database = nullptr;
  Must(sqlite3_open(path.c_str(), &database), database);
  Execute(database,
          "PRAGMA journal_mode = WAL; PRAGMA synchronous = FULL; "
          "CREATE TABLE readings (session INTEGER, row_index INTEGER, reading BLOB, "
          "PRIMARY KEY (session, row_index)) WITHOUT ROWID");
  sqlite3_stmt* begin = Prepare(database, "BEGIN IMMEDIATE");
  sqlite3_stmt* commit = Prepare(database, "COMMIT");
  sqlite3_stmt* insert = Prepare(database, "INSERT INTO readings VALUES (1, ?1, ?2)");
  for (int row = 0; row < rows;) {
    Step(database, begin);
    for (const int end = row + batch; row < end; ++row) Insert(database, insert, row);
    Step(database, commit);
  }
  for (sqlite3_stmt* statement : {begin, commit, insert}) sqlite3_finalize(statement);
  sqlite3_close(database);
}

}  // namespace truepose::bench
