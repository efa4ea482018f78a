// The LCM types of what is told and recorded: one for each group of the registry, and those of
// texts, datagrams and CAN frames. As text for lcm-gen, and as the fingerprints that messages bear.
//   out    package pitwall; GROUP_t: utime, then each field as double, NaN where it is not known
//   units  utime: microseconds since 1970; fields as the registry has them
//   invariants
//          a fingerprint depends on names, types and sizes of the members, not on the type's name:
//          a reader with another registry refuses the message instead of misreading it
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
  std::string_view size = {};  // of an array: the member that has it
  std::string_view unit = {};
};
struct LcmType {
  std::string name;
  std::vector<LcmMember> members;
};

LcmType lcm_type(Group group);
LcmType lcm_text_type();      // utime, json
LcmType lcm_datagram_type();  // utime, path, address and port of the other end, size, data
LcmType lcm_bytes_type();     // utime, size, data: what a receiver said
LcmType lcm_can_type();       // utime, id, extended, remote, fd, size, data

std::uint64_t lcm_fingerprint(const LcmType& type);

// All of them, as lcm-gen reads it.
std::string lcm_types_text();

}  // namespace pitwall::telemetry
