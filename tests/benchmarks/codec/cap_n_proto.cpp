// SPDX-License-Identifier: Apache-2.0
#include <capnp/message.h>
#include <capnp/serialize-packed.h>
#include <kj/io.h>
#include <state.capnp.h>

#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {

Peer cap_n_proto() {
  const auto encode = [](const Values& v, std::span<std::uint8_t> out) {
    ::capnp::MallocMessageBuilder builder;
    auto state = builder.initRoot<codec_schema::State>();
#define REAL(n) state.setF##n(real_of(v, n - 1));
#define INTEGER(n) state.setI##n(integer_of(v, n - 1));
#define YES_NO(n) state.setB##n(yes_no_of(v, n - 1));
#include <state_fields.inc>
#undef REAL
#undef INTEGER
#undef YES_NO
    kj::ArrayOutputStream stream(kj::arrayPtr(out.data(), out.size()));
    ::capnp::writePackedMessage(stream, builder);
    return stream.getArray().size();
  };
  const auto decode = [](Bytes bytes, Values& v) {
    kj::ArrayInputStream stream(kj::arrayPtr(bytes.data(), bytes.size()));
    ::capnp::PackedMessageReader reader(stream);
    const auto state = reader.getRoot<codec_schema::State>();
#define REAL(n) v[kReals[n - 1]] = static_cast<double>(state.getF##n());
#define INTEGER(n) v[kIntegers[n - 1]] = state.getI##n();
#define YES_NO(n) v[kYesNos[n - 1]] = state.getB##n() ? 1 : 0;
#include <state_fields.inc>
#undef REAL
#undef INTEGER
#undef YES_NO
    return true;
  };
  return {"Cap'n Proto packed, float", "capnp", Keeps::kFloat, encode, decode};
}

}  // namespace pitwall::codec
