// Encodings of the vehicle state to compare in `bench codec`; main measures their sizes and times.
//   invariants
//          decode(encode(x)) is x within the precision of the encoding; checked for every frame
//   errors an encoding whose library is missing is not in the list; main reports it
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/telemetry/packet/vehicle_state.hpp"

namespace pitwall::codec {

using telemetry::FieldIndex;
using telemetry::FieldKind;
using telemetry::Values;
using Bytes = std::span<const std::uint8_t>;

template <std::size_t kCount>
constexpr std::array<FieldIndex, kCount> fields_of_kind(FieldKind kind) {
  std::array<FieldIndex, kCount> fields{};
  std::size_t at = 0;
  for (const FieldIndex i : telemetry::kVehicleState) {
    if (telemetry::kFields[i].kind() == kind) fields[at++] = i;
  }
  return fields;
}
inline constexpr auto kReals = fields_of_kind<84>(FieldKind::kReal);
inline constexpr auto kIntegers = fields_of_kind<10>(FieldKind::kInteger);
inline constexpr auto kYesNos = fields_of_kind<6>(FieldKind::kYesNo);

inline float real_of(const Values& v, std::size_t i) { return static_cast<float>(v[kReals[i]]); }
inline std::int32_t integer_of(const Values& v, std::size_t i) {
  return static_cast<std::int32_t>(v[kIntegers[i]]);
}
inline bool yes_no_of(const Values& v, std::size_t i) { return v[kYesNos[i]] != 0.0; }

// Precision of the values in the encoding.
enum class Keeps : std::uint8_t { kSteps, kFloat, kDouble };

struct Peer {
  std::string name;
  std::string bytes_by;  // program or library that writes the bytes
  Keeps keeps = Keeps::kFloat;
  // Writes to `out`, which is large enough; returns the size.
  std::function<std::size_t(const Values&, std::span<std::uint8_t> out)> encode;
  std::function<bool(Bytes, Values&)> decode;
};

// Sizes in bytes, as means over the trace. An encoding that was not timed has no times.
struct Measured {
  std::string name, bytes_by;
  double payload = 0.0;   // size of the values
  double datagram = 0.0;  // UDP payload
  bool authenticated = false;
  std::optional<double> encode_ns, decode_ns;
};

Peer ours();
// `plain` as one datagram of our session: header, encrypted values, tag. The body of `plain` has at
// most telemetry::kMaxBody bytes.
Peer sealed(const Peer& plain, const std::string& name);
std::vector<Peer> protobuf();
Peer lcm();
inline constexpr std::size_t kLcmHeader = 8 + sizeof("STATE");  // short LCM UDP message
std::vector<Peer> cdr();
Peer flatbuffers();
Peer cap_n_proto();
Peer json();
// Over loopback to a reader in another process; empty if it cannot be measured.
std::optional<Measured> cyclone(const std::vector<Values>& trace);
// Sizes by node-mavlink, without times because it is JavaScript; empty if it is not installed.
std::vector<Measured> mavlink(const std::vector<Values>& trace);

}  // namespace pitwall::codec
