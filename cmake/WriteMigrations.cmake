# cmake -DOUTPUT=FILE -DFOLDER=DIR -P WriteMigrations.cmake: each NNNN_name.sql, byte for byte, as one raw string literal.
file(GLOB files ${FOLDER}/*.sql)
list(SORT files)
set(rows "")
foreach(file IN LISTS files)
  get_filename_component(name ${file} NAME_WE)
  if(NOT name MATCHES "^([0-9][0-9][0-9][0-9])_([a-z0-9_]+)$")
    message(FATAL_ERROR "migrations: found ${name}, expected NNNN_name")
  endif()
  set(digits ${CMAKE_MATCH_1})
  set(title ${CMAKE_MATCH_2})
  string(REGEX MATCH "[1-9][0-9]*$" number ${digits})
  file(READ ${file} text)
  string(APPEND rows "    {${number}, \"${title}\", R\"sql(${text})sql\"},\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from migrations/ by cmake/WriteMigrations.cmake.
#include \"server/store/migrations.h\"

namespace truepose::store {
namespace {

constexpr Migration kMigrations[] = {
${rows}};

}  // namespace

std::span<const Migration> EmbeddedMigrations() { return kMigrations; }

}  // namespace truepose::store
")
