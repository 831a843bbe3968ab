#include "bench/shared_problem.h"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace truepose::bench {
namespace {

std::vector<std::vector<double>> ReadRows(const std::string& path) {
  std::ifstream file(path);
  std::string line, cell;
  if (!std::getline(file, line)) {
    std::fprintf(stderr, "can't read %s; TRUEPOSE_SHARED names the folder with bench/\n", path.c_str());
    std::exit(3);
  }
  std::vector<std::vector<double>> rows;
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::strtod(cell.c_str(), nullptr));
  }
  return rows;
}

MeasuredPose ToPose(const std::vector<double>& row) {
  const auto end = row.end();
  return {{row.begin(), end - 7}, {end[-7], end[-6], end[-5]}, {end[-4], end[-3], end[-2], end[-1]}};
}

}  // namespace

std::string SharedFolder() {
  const char* folder = std::getenv("TRUEPOSE_SHARED");
  return folder != nullptr ? folder : TRUEPOSE_SOURCE_DIR "/../shared";
}

SharedProblem ReadSharedProblem(const std::string& name, int poses) {
  const std::string stem = SharedFolder() + "/bench/" + name + "_";
  SharedProblem problem;
  for (const std::vector<double>& row : ReadRows(stem + "params.csv")) {
    problem.nominal.push_back(row.at(1));
    problem.truth.push_back(row.at(2));
    problem.free.push_back(row.at(3) != 0);
  }
  for (const std::vector<double>& row : ReadRows(stem + std::to_string(poses) + ".csv")) {
    problem.poses.push_back(ToPose(row));
  }
  return problem;
}

}  // namespace truepose::bench
