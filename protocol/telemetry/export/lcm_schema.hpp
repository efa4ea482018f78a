// LCM types of the published and recorded messages: one for each group of the registry, and those
// for texts, datagrams, bytes of receivers and CAN frames; as text for lcm-gen and as fingerprints.
//   out    package pitwall; GROUP_t: utime, then each field as double, NaN if it is not known
//   units  utime: microseconds since 1970; fields in the units of the registry
//   invariants
//          a fingerprint depends on names, types and sizes of the members, not on the type's name:
//          a reader with another registry rejects the message instead of misreading it
//   source lcm-gen of LCM 1.3.1: lcmgen.c (lcm_struct_hash), emit_c.c (its rotation)
//   cost   allocates; fingerprints are made once
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/telemetry/registry/registry.hpp"

namespace pitwall::telemetry {

struct LcmMember {
  std::string_view type;
  std::string name;
  std::string_view size = {};  // for an array: the name of the member with its length
  std::string_view unit = {};
};
struct LcmType {
  std::string name;
  std::vector<LcmMember> members;
};

LcmType lcm_type(Group group);
LcmType lcm_text_type();      // utime, json
LcmType lcm_datagram_type();  // utime, path, address and port of the other end, size, data
LcmType lcm_bytes_type();     // utime, size, data: bytes from a receiver
LcmType lcm_can_type();       // utime, id, extended, remote, fd, size, data

std::uint64_t lcm_fingerprint(const LcmType& type);

// All types in the input format of lcm-gen.
std::string lcm_types_text();

}  // namespace pitwall::telemetry
