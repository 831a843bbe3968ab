// write_table PATH: a small whole table, for tests of programs that read one.
#include <cstdio>
#include <fstream>

#include "compensation/encode_table.h"
#include "tests/compensation/table_samples.h"

int main(int argc, char** argv) {
  if (argc != 2) return std::fputs("write_table PATH\n", stderr), 2;
  const std::vector<std::byte> bytes =
      truepose::compensation::Encode(truepose::compensation::testing::SmallTable());
  std::ofstream file(argv[1], std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()),
             static_cast<std::streamsize>(bytes.size()));
  return file.flush() ? 0 : 1;
}
