// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {

// By hand: {"ego.x":12.345,...}, as many digits as a float has.
Peer json() {
  const auto encode = [](const Values& v, std::span<std::uint8_t> out) {
    auto* text = reinterpret_cast<char*>(out.data());
    std::size_t at = 0;
    for (const FieldIndex i : telemetry::kVehicleState) {
      const telemetry::FieldRow& row = telemetry::kFields[i];
      const auto group = telemetry::row_of(row.group).name;
      at += static_cast<std::size_t>(
          std::snprintf(text + at, out.size() - at, "%c\"%.*s.%.*s\":%.7g", at == 0 ? '{' : ',',
                        static_cast<int>(group.size()), group.data(),
                        static_cast<int>(row.name.size()), row.name.data(), v[i]));
    }
    text[at++] = '}';
    return at;
  };
  const auto decode = [](Bytes bytes, Values& v) {
    const std::string text(bytes.begin(), bytes.end());
    const char* at = text.c_str();
    for (const FieldIndex i : telemetry::kVehicleState) {
      at = std::strchr(at, ':');
      if (at == nullptr) return false;
      v[i] = std::strtod(at + 1, nullptr);
      ++at;
    }
    return true;
  };
  return {"JSON", "by hand", Keeps::kFloat, encode, decode};
}

}  // namespace pitwall::codec
