#include "formats/column.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include "formats/strings.h"
#include "formats/wording.h"

namespace truepose::formats {
namespace {

bool IsThere(const Column& column) { return column.cell != Column::kMissing; }

// The name that a missing column would have beside a column of its group.
std::string NameBeside(const KnownColumn& known, const Column& beside) {
  if (beside.unit != nullptr && beside.unit->dimension == known.dimension) {
    return StrCat(known.stem, "_", beside.unit->symbol);
  }
  return AnyOf(NamesWithUnits(known.stem, known.dimension));
}

}  // namespace

Columns::Columns(const CsvRow& header, const std::vector<KnownColumn>& known_columns,
                 std::string_view file_name, FaultList& faults)
    : where_(StrCat(file_name, ":", header.line, ": ")), faults_(faults), groups_(kQuantities) {
  for (const KnownColumn& known : known_columns) GroupOf(known).columns.emplace_back();
  std::unordered_set<std::string_view> names;
  for (size_t i = 0; i < header.cells.size(); ++i) {
    const std::string_view name = header.cells[i];
    if (name.empty()) {
      AddFault(StrCat("column ", i + 1), "no name", "a name");
    } else if (!names.insert(name).second) {
      AddFault(name, "a second column of that name", "one");
    } else {
      Bind(known_columns, name, static_cast<int>(i));
    }
  }
  CheckComplete(known_columns);
}

const ColumnGroup* Columns::Find(Quantity quantity) const {
  const ColumnGroup& group = groups_[static_cast<size_t>(quantity)];
  const bool there = std::any_of(group.columns.begin(), group.columns.end(), IsThere);
  return there ? &group : nullptr;
}

void Columns::Bind(const std::vector<KnownColumn>& known_columns, std::string_view name, int cell) {
  for (const KnownColumn& known : known_columns) {
    const Unit* unit = nullptr;
    if (IsNameOf(known, name, &unit)) return Place(known, {std::string(name), cell, unit});
  }
  if (!HasFault(known_columns, name, cell)) extra_.push_back({std::string(name), cell, nullptr});
}

void Columns::Place(const KnownColumn& known, Column column) {
  Column& place = GroupOf(known).columns[known.index];
  if (IsThere(place)) {
    AddFault(column.name, StrCat("a second column of ", known.stem), StrCat("only ", place.name));
  } else {
    place = std::move(column);
  }
}

bool Columns::HasFault(const std::vector<KnownColumn>& known_columns, std::string_view name,
                       int cell) {
  for (const KnownColumn& known : known_columns) {
    if (!IsSlipOf(known, name)) continue;
    AddFault(name, StrCat("the header ", Quoted(name)),
             AnyOf(NamesWithUnits(known.stem, known.dimension)));
    Column& place = GroupOf(known).columns[known.index];
    if (!IsThere(place)) place = {std::string(name), cell, nullptr, false};
    return true;
  }
  return HasNumberBeyond(name);
}

bool Columns::HasNumberBeyond(std::string_view name) {
  const auto columns_of = [&](Quantity quantity) {
    return groups_[static_cast<size_t>(quantity)].columns.size();
  };
  std::string expected;
  if (LooksLikeJoint(name)) {
    const size_t joints = columns_of(Quantity::kMeasuredJoint);
    expected = StrCat("a joint from 1 to ", joints, ", as many as the robot has");
  } else if (LooksLikePoint(name) && columns_of(Quantity::kPoint1) > 0) {
    expected = StrCat("a point from 1 to ", kMostPoints);
  }
  if (!expected.empty()) AddFault(name, StrCat("the header ", Quoted(name)), expected);
  return !expected.empty();
}

void Columns::CheckComplete(const std::vector<KnownColumn>& known_columns) {
  for (ColumnGroup& group : groups_) group.complete = true;
  for (const KnownColumn& known : known_columns) {
    ColumnGroup& group = GroupOf(known);
    const auto beside = std::find_if(group.columns.begin(), group.columns.end(), IsThere);
    const Column& column = group.columns[known.index];
    if ((IsThere(column) && column.readable) || beside == group.columns.end()) continue;
    if (!IsThere(column) && MayBeMissing(known)) continue;
    group.complete = false;
    if (IsThere(column)) continue;
    AddFault(NameBeside(known, *beside), "no such column", StrCat("one beside ", beside->name));
  }
}

bool Columns::MayBeMissing(const KnownColumn& known) const {
  if (!known.alone) return false;
  if (known.quantity == Quantity::kPosition) {
    return !Find(Quantity::kQuaternion) && !Find(Quantity::kEuler) && !Find(Quantity::kAxis);
  }
  const ColumnGroup* position = Find(Quantity::kPosition);
  return position != nullptr && !IsThere(position->columns[known.index]);
}

ColumnGroup& Columns::GroupOf(const KnownColumn& known) {
  return groups_[static_cast<size_t>(known.quantity)];
}

void Columns::AddFault(std::string_view column, std::string found, std::string expected) {
  // A name is as long as the file makes it.
  const std::string shown = column.size() > 60 ? Quoted(column) : std::string(column);
  faults_.Add(StrCat(where_, shown), std::move(found), std::move(expected));
}

}  // namespace truepose::formats
