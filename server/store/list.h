// One page of rows, read the same way by every list.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
#include "absl/strings/str_cat.h"
#include "core/base/status_macros.h"
#include "server/store/page.h"
#include "server/store/sql/connection.h"

namespace truepose::store {

// `rows` yields one row more than the page, if there is one (LIMIT size + 1), with the key in
// column 0.
// @param read makes an item of a row.
template <typename T>
absl::StatusOr<Page<T>> ReadPage(
    const ListId& id, int size, sql::Statement& rows,
    const std::function<absl::StatusOr<T>(const sql::Statement&)>& read) {
  Page<T> page;
  std::string last_key;
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows.Step());
    if (!found) return page;
    if (static_cast<int>(page.items.size()) == size) break;
    TRUEPOSE_ASSIGN_OR_RETURN(T item, read(rows));
    page.items.push_back(std::move(item));
    last_key = rows.Text(0);
  }
  page.next_page_token = MakePageToken(id, last_key);
  return page;
}

// What a list leaves out beside its key columns.
template <typename T>
struct ListFilter {
  std::string text;  // as asked for; a page token is bound to it
  bool show_deleted = false;
  std::function<bool(const T&)> belongs;  // empty = all

  std::string Key() const { return absl::StrCat(show_deleted ? "deleted|" : "", text); }
};

// The same for a list with a filter: `rows` yields all rows that are left, and items that don't
// belong count for no page.
template <typename T>
absl::StatusOr<Page<T>> ReadFilteredPage(
    const ListId& id, int size, sql::Statement& rows, const ListFilter<T>& filter,
    const std::function<absl::StatusOr<T>(const sql::Statement&)>& read) {
  Page<T> page;
  std::string last_key;
  for (;;) {
    TRUEPOSE_ASSIGN_OR_RETURN(const bool found, rows.Step());
    if (!found) return page;
    if (static_cast<int>(page.items.size()) == size) break;
    TRUEPOSE_ASSIGN_OR_RETURN(T item, read(rows));
    last_key = rows.Text(0);
    if (!filter.belongs || filter.belongs(item)) page.items.push_back(std::move(item));
  }
  page.next_page_token = MakePageToken(id, last_key);
  return page;
}

}  // namespace truepose::store
