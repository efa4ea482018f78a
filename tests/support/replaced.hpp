// A text with one of its parts replaced, at its first place. A missing part ends the test.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace pitwall::testing {

inline std::string replaced(std::string text, std::string_view part, std::string_view by) {
  const std::size_t at = text.find(part);
  if (at == std::string::npos) throw std::runtime_error("no " + std::string{part});
  return text.replace(at, part.size(), by);
}

}  // namespace pitwall::testing
