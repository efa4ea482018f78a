// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/live/programs.hpp"

#include <filesystem>

namespace pitwall::cli {

namespace fs = std::filesystem;

std::string own_program() { return fs::read_symlink("/proc/self/exe").string(); }

std::string beside(const std::string& program) {
  return (fs::path(own_program()).parent_path().parent_path() / program).string();
}

}  // namespace pitwall::cli
