// SPDX-License-Identifier: Apache-2.0
#include <codec_schema/state_t.hpp>

#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {

Peer lcm() {
  const auto encode = [](const Values& v, std::span<std::uint8_t> out) {
    codec_schema::state_t message;
    for (std::size_t i = 0; i < kReals.size(); ++i) message.floats[i] = real_of(v, i);
    for (std::size_t i = 0; i < kIntegers.size(); ++i) message.integers[i] = integer_of(v, i);
    for (std::size_t i = 0; i < kYesNos.size(); ++i) message.flags[i] = yes_no_of(v, i) ? 1 : 0;
    return static_cast<std::size_t>(message.encode(out.data(), 0, static_cast<int>(out.size())));
  };
  const auto decode = [](Bytes bytes, Values& v) {
    codec_schema::state_t message;
    const int size = static_cast<int>(bytes.size());
    if (message.decode(bytes.data(), 0, size) != size) return false;
    for (std::size_t i = 0; i < kReals.size(); ++i) {
      v[kReals[i]] = static_cast<double>(message.floats[i]);
    }
    for (std::size_t i = 0; i < kIntegers.size(); ++i) v[kIntegers[i]] = message.integers[i];
    for (std::size_t i = 0; i < kYesNos.size(); ++i) v[kYesNos[i]] = message.flags[i];
    return true;
  };
  return {"LCM, float", "lcm-gen", Keeps::kFloat, encode, decode};
}

}  // namespace pitwall::codec
