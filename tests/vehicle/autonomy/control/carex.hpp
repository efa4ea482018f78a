// Reads the continuous-time Riccati benchmark files (CAREX, by SLICOT BB01AD) where they are.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>

namespace pitwall::control::testing {

// "A 2 2" and then the rows; other lines are comments or sizes.
inline std::map<std::string, Eigen::MatrixXd> read_matrices(const std::filesystem::path& file) {
  std::map<std::string, Eigen::MatrixXd> matrices;
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line)) {
    std::istringstream head(line);
    std::string name;
    Eigen::Index rows = 0, columns = 0;
    if (line.starts_with('#') || line.starts_with("n ")) continue;
    if (!(head >> name >> rows >> columns)) continue;
    Eigen::MatrixXd m(rows, columns);
    for (Eigen::Index i = 0; i < rows; ++i)
      for (Eigen::Index j = 0; j < columns; ++j) in >> m(i, j);
    matrices[name] = m;
  }
  return matrices;
}

}  // namespace pitwall::control::testing
