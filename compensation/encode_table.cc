#include "compensation/encode_table.h"

#include "compensation/check_table.h"
#include "compensation/table_digest.h"
#include "compensation/table_fields.h"

namespace truepose::compensation {

TableReport Check(const TableContent& content) noexcept {
  return CheckTable(content.header, content.arm, content.axis, content.nodes);
}

std::vector<std::byte> Encode(const TableContent& content) {
  if (!Check(content).ok()) return {};
  const std::span nodes = std::as_bytes(std::span(content.nodes));
  std::vector<std::byte> file(kNodesAt + nodes.size());
  TablePrologue prologue;
  prologue.total_bytes = file.size();
  FieldWriter writer(file.data());
  VisitPrologue(writer, prologue);
  VisitFields(writer, content.header, content.arm, content.axis);
  std::copy(nodes.begin(), nodes.end(), file.begin() + kNodesAt);
  prologue.digest = DigestOfTable(file);
  FieldWriter again(file.data());
  VisitPrologue(again, prologue);
  return file;
}

}  // namespace truepose::compensation
