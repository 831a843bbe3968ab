#include "tests/core/testing/table.h"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace truepose::testing {

std::string SharedFolder() {
  const char* folder = std::getenv("TRUEPOSE_SHARED");
  if (folder == nullptr) throw std::runtime_error("TRUEPOSE_SHARED is not set");
  return folder;
}

std::vector<std::vector<double>> ReadTable(const std::string& path) {
  std::ifstream file(path);
  if (!file)
    throw std::runtime_error("can't read " + path +
                             "; TRUEPOSE_SHARED names the folder of the measured data");
  std::string line, cell;
  std::getline(file, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) {
      rows.back().push_back(cell.empty() ? std::numeric_limits<double>::quiet_NaN()
                                         : std::stod(cell));
    }
  }
  return rows;
}

}  // namespace truepose::testing
