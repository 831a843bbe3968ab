// Tables of numbers from the folder of measured and simulated data.
#pragma once

#include <string>
#include <vector>

namespace truepose::testing {

// Folder with data/ and bench/, from the environment; a test that needs it fails without it.
std::string SharedFolder();

// Rows of a CSV file without its header; an empty cell is not a number. Throws when the file can't
// be read.
std::vector<std::vector<double>> ReadTable(const std::string& path);

}  // namespace truepose::testing
