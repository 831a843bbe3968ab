// One page of rows, read the same way by every list.
#pragma once

#include <functional>
#include <string>
#include <utility>

#include "absl/status/statusor.h"
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

}  // namespace truepose::store
