// SPDX-License-Identifier: Apache-2.0
#include "protocol/can/decode.hpp"

#include "protocol/vocabulary/check.hpp"
#include "protocol/vocabulary/units.hpp"

namespace pitwall::can {

bool is_frame_of(const Message& message, const Frame& frame) {
  return frame.id == message.id && frame.extended == message.extended && !frame.remote &&
         frame.fd == message.fd && frame.length == message.length;
}

bool is_present(const Message& message, const Signal& signal, const Frame& frame) {
  for (const Signal* s = &signal; s->selector; s = &message.signals[*s->selector]) {
    const std::uint64_t chosen = extract(message.signals[*s->selector].plan, frame.data);
    bool in_range = false;
    for (const SelectorRange& r : s->when) in_range |= chosen >= r.low && chosen <= r.high;
    if (!in_range) return false;
  }
  return true;
}

double decode(const Signal& signal, const Frame& frame) {
  return physical_of(extract(signal.plan, frame.data), signal.plan);
}

bool decode(const Message& message, const Frame& frame, std::span<double> values) {
  CHECK(values.size() == message.signals.size());
  if (!is_frame_of(message, frame)) return false;
  if (message.deepest == 0 && message.length <= 8) {
    // The usual case: every plan begins at byte 0, so two words hold all signals.
    const std::uint64_t intel = load_intel(frame.data), motorola = load_motorola(frame.data);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const SignalPlan& p = message.signals[i].plan;
      const std::uint64_t word = p.order == ByteOrder::kIntel ? intel : motorola;
      values[i] = physical_of(word >> p.shift & p.mask, p);
    }
    return true;
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Signal& s = message.signals[i];
    values[i] = is_present(message, s, frame) ? decode(s, frame) : kUnset;
  }
  return true;
}

}  // namespace pitwall::can
