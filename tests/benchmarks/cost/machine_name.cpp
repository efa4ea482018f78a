// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/cost/machine_name.hpp"

#include <sstream>

#include "protocol/transport/file.hpp"

namespace pitwall::cost {
namespace {

std::string first_line(std::string_view text) {
  return std::string{text.substr(0, text.find('\n'))};
}

}  // namespace

std::string machine_name(std::string_view cpuinfo, std::string_view release) {
  std::istringstream lines{std::string{cpuinfo}};
  std::string line, model;
  int cores = 0;
  while (std::getline(lines, line)) {
    if (line.starts_with("processor")) ++cores;
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos)
      model = line.substr(colon + 2);
  }
  const std::string kernel = first_line(release);
  return (model.empty() ? "unknown processor" : model) + ", " + std::to_string(cores) +
         (cores == 1 ? " core" : " cores") + ", Linux " + (kernel.empty() ? "unknown" : kernel);
}

std::string machine_name() {
  return machine_name(transport::read_file("/proc/cpuinfo").value_or(""),
                      transport::read_file("/proc/sys/kernel/osrelease").value_or(""));
}

}  // namespace pitwall::cost
