// SPDX-License-Identifier: Apache-2.0
// Any text that another end may send as its registry is read, and told apart from ours: nothing
// breaks, what is listing stays short, and only our own text has no difference.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "protocol/telemetry/registry/schema_difference.hpp"
#include "protocol/telemetry/registry/schema_listing.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall::telemetry;

// Half of the inputs are pieces put into our own text: place u16, length cut out u8, the piece.
std::string text_of(std::string_view data, const std::string& ours) {
  if (data.size() < 4 || static_cast<unsigned char>(data[0]) % 2 == 0) return std::string{data};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(data[i]); };
  std::string text = ours;
  const std::size_t at = (byte(1) * 256U + byte(2)) % text.size();
  text.replace(at, std::min<std::size_t>(byte(3), text.size() - at), data.substr(4));
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string kOurs = safety_text();
  const std::string text = text_of({reinterpret_cast<const char*>(data), size}, kOurs);
  const std::string listing = difference(kOurs, text);
  CHECK(listing.empty() == (text == kOurs));
  const auto lines = std::count(listing.begin(), listing.end(), '\n');
  CHECK(static_cast<std::size_t>(lines) <= kDifferencesMax + 1);
  CHECK(difference(text, text).empty());
  return 0;
}
