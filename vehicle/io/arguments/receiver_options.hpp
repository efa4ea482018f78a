// The options of a command line that say how the receivers' bytes come in; the same for the car and
// for its guardian.
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

inline constexpr int kExitUsage = 2;  // the command line is wrong

class ReceiverOptions {
 public:
  explicit ReceiverOptions(CLI::App& app);

  ReceiverLinks links() const;  // after the words were read

 private:
  std::vector<std::uint16_t> ports_;
  std::vector<std::string> words_;
};

}  // namespace pitwall::io
