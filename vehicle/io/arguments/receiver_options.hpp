// Command-line options for the links of the receivers, common to the car and its guardian.
//   errors CLI::ValidationError that names the option
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vehicle/io/arguments/receiver_link.hpp"

namespace CLI {
class App;
}

namespace pitwall::io {

inline constexpr int kExitUsage = 2;  // wrong command line

class ReceiverOptions {
 public:
  explicit ReceiverOptions(CLI::App& app);

  ReceiverLinks links() const;  // after parsing

 private:
  std::vector<std::uint16_t> ports_;
  std::vector<std::string> words_;
};

}  // namespace pitwall::io
