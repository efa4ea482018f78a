// SPDX-License-Identifier: Apache-2.0
#include <state_generated.h>

#include <algorithm>

#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {

Peer flatbuffers() {
  const auto encode = [](const Values& v, std::span<std::uint8_t> out) {
    static ::flatbuffers::FlatBufferBuilder builder(2'048);
    builder.Clear();
    codec_schema::StateBuilder state(builder);
#define REAL(n) state.add_f##n(real_of(v, n - 1));
#define INTEGER(n) state.add_i##n(integer_of(v, n - 1));
#define YES_NO(n) state.add_b##n(yes_no_of(v, n - 1));
#include <state_fields.inc>
#undef REAL
#undef INTEGER
#undef YES_NO
    builder.Finish(state.Finish());
    std::copy_n(builder.GetBufferPointer(), builder.GetSize(), out.data());
    return static_cast<std::size_t>(builder.GetSize());
  };
  const auto decode = [](Bytes bytes, Values& v) {
    ::flatbuffers::Verifier verifier(bytes.data(), bytes.size());
    if (!codec_schema::VerifyStateBuffer(verifier)) return false;
    const codec_schema::State& state = *codec_schema::GetState(bytes.data());
#define REAL(n) v[kReals[n - 1]] = static_cast<double>(state.f##n());
#define INTEGER(n) v[kIntegers[n - 1]] = state.i##n();
#define YES_NO(n) v[kYesNos[n - 1]] = state.b##n() ? 1 : 0;
#include <state_fields.inc>
#undef REAL
#undef INTEGER
#undef YES_NO
    return true;
  };
  return {"FlatBuffers, float", "flatc", Keeps::kFloat, encode, decode};
}

}  // namespace pitwall::codec
