// Interface to the disk that holds the files of a recording; one file is open at a time.
//   errors Problem if a file cannot be created; append(): false, and problem() has the reason
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "protocol/vocabulary/result.hpp"

namespace pitwall::recorder {

class Disk {
 public:
  virtual ~Disk() = default;
  virtual std::optional<Problem> begin(const std::string& name) = 0;  // a new file
  virtual bool append(std::span<const std::uint8_t> bytes) = 0;
  virtual void end(bool keep) = 0;
  virtual std::string problem() const = 0;  // of the last failed append
  virtual std::uint64_t free_bytes() const = 0;
};

}  // namespace pitwall::recorder
