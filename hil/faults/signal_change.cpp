// SPDX-License-Identifier: Apache-2.0
#include "hil/faults/signal_change.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace pitwall::faults {
namespace {

// All little-endian.
struct Field {
  std::uint32_t id;
  std::uint8_t unit, start, bits;
  bool is_signed;
  double scale;
};

constexpr std::array kFields{Field{1300, 0, 0, 16, false, 0.1},   // wheel speeds FL, FR, RL, RR
                             Field{1300, 1, 16, 16, false, 0.1},  //
                             Field{1300, 2, 32, 16, false, 0.1},  //
                             Field{1300, 3, 48, 16, false, 0.1},  //
                             Field{1301, 0, 0, 13, false, 1.0},   // brake pressure front, rear
                             Field{1301, 1, 16, 13, false, 1.0},  //
                             Field{1302, 0, 0, 16, false, 0.1},   // accelerator pedal
                             Field{1303, 0, 0, 11, true, 0.5},    // steering motor
                             Field{1304, 0, 8, 8, false, 1.0},    // sys_state
                             Field{1200, 0, 4, 4, false, 1.0},    // track flag, MyLaps
                             Field{1250, 0, 0, 8, false, 1.0}};   // track flag, Marelli

const Field* field_of(std::uint32_t id, std::uint32_t unit) {
  for (const Field& field : kFields)
    if (field.id == id && field.unit == unit) return &field;
  return nullptr;
}

std::int64_t raw_of(const can::Frame& frame, const Field& field) {
  std::int64_t raw = 0;
  for (std::uint32_t i = field.bits; i-- > 0;) {
    const std::uint32_t bit = field.start + i;
    raw = raw * 2 + (frame.data[bit / 8] >> (bit % 8) & 1);
  }
  const std::int64_t sign = std::int64_t{1} << (field.bits - 1);
  return field.is_signed && raw >= sign ? raw - 2 * sign : raw;
}

void put_raw(can::Frame& frame, const Field& field, double value) {
  const double span = std::ldexp(1.0, field.bits);
  const double least = field.is_signed ? -span / 2.0 : 0.0;
  const double raw = std::clamp(std::round(value / field.scale), least, least + span - 1.0);
  const auto bits = static_cast<std::uint64_t>(static_cast<std::int64_t>(raw));
  for (std::uint32_t i = 0; i < field.bits; ++i) {
    const std::uint32_t bit = field.start + i;
    const auto mask = static_cast<std::uint8_t>(1U << (bit % 8));
    std::uint8_t& byte = frame.data[bit / 8];
    byte = static_cast<std::uint8_t>((bits >> i & 1U) != 0U ? byte | mask : byte & ~mask);
  }
}

}  // namespace

bool has_signal(std::uint32_t id, std::uint32_t unit) { return field_of(id, unit) != nullptr; }

void add_to_signal(can::Frame& frame, std::uint8_t unit, double value) {
  const Field* field = field_of(frame.id, unit);
  if (field == nullptr) return;
  put_raw(frame, *field, static_cast<double>(raw_of(frame, *field)) * field->scale + value);
}

void set_signal(can::Frame& frame, std::uint8_t unit, double value) {
  if (const Field* field = field_of(frame.id, unit)) put_raw(frame, *field, value);
}

}  // namespace pitwall::faults
