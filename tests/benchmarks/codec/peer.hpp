// One way to write the vehicle's state, for `bench codec`: bytes and times are measured by main.
//   invariants
//          decode(encode(x)) is x as far as the encoding keeps it; it is checked for every frame
//   errors a contestant whose library is not there is not in the list; main says so
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/telemetry/registry/vehicle_state.hpp"

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

// What the encoding keeps of a value.
enum class Keeps : std::uint8_t { kSteps, kFloat, kDouble };

struct Peer {
  std::string name;
  std::string bytes_by;  // what wrote them
  Keeps keeps = Keeps::kFloat;
  // Into `out`, which is large enough; the size.
  std::function<std::size_t(const Values&, std::span<std::uint8_t> out)> encode;
  std::function<bool(Bytes, Values&)> decode;
};

// Bytes, means over the trace. A form that was not timed here has no times.
struct Measured {
  std::string name, bytes_by;
  double payload = 0.0;   // of the values
  double datagram = 0.0;  // UDP payload
  bool authenticated = false;
  std::optional<double> encode_ns, decode_ns;
};

Peer ours();
// The same as one datagram of our session: header, encrypted values, tag. The body of `plain` is at
// most telemetry::kMaxBody bytes.
Peer sealed(const Peer& plain, const std::string& name);
std::vector<Peer> protobuf();
Peer lcm();
inline constexpr std::size_t kLcmHeader = 8 + sizeof("STATE");  // LCM UDP multicast protocol, short
std::vector<Peer> cdr();
Peer flatbuffers();
Peer cap_n_proto();
Peer json();
// Over loopback to a reader of another process; none: it could not be measured.
std::optional<Measured> cyclone(const std::vector<Values>& trace);
// Sizes by node-mavlink, no times (it is JavaScript); empty: it is not installed.
std::vector<Measured> mavlink(const std::vector<Values>& trace);

}  // namespace pitwall::codec
