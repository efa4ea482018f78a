// Selection of the paths for the packets of a slot, and of the peer's address on each path.
//   out    one plan per packet; no plan if no path has room
//   invariants
//          kDuplicate: one packet on all paths that have room. kBest: safety content on all paths,
//          the rest on the better one. A path on which an address is not yet validated, or that has
//          much less room than the other, gets its own packet
//          the token that proves an address is sent to that address only: the packet on the slot
//          goes to the address on trial, the packet half a slot later to the validated one
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "protocol/telemetry/endpoint/path_lane.hpp"
#include "protocol/telemetry/packet/body.hpp"
#include "protocol/telemetry/packet/header.hpp"
#include "protocol/telemetry/session/association.hpp"
#include "protocol/vocabulary/fixed_vector.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::telemetry {

// Distribution of the content over two paths.
enum class PathPolicy : std::uint8_t {
  kDuplicate,  // everything on all paths that have room
  kBest        // safety content on all paths, the rest on the better one
};

// Bytes of a packet beside its body: header and tag.
inline constexpr std::size_t kAround = kHeaderSize + kTagSize;
inline constexpr std::size_t kTokenSize = 8;  // of kPathProbe and kPathProof

constexpr bool has(std::uint8_t paths, PathId path) { return (paths & bit_of(path)) != 0; }

// Plan of one packet that may be sent now.
struct PacketPlan {
  std::uint8_t paths = 0;       // bit mask of the paths that it is sent on
  std::size_t safety_room = 0;  // bytes of the body if it has safety content only
  bool only_safety = false;     // all other content goes on the other path
  bool between = false;         // half a slot later
  bool trial = false;           // to the address that is not yet validated
  std::size_t most = kMaxBody;  // largest body that may be sent to that address
  double rate = 0.0;            // present rate of the slowest of its paths, bytes per second
};

struct PathChoice {
  const Association& association;
  std::span<const PathLane> lanes;
  PathPolicy policy;
  // No acknowledgement came lately: a packet between slots is sent even if there is little room.
  bool in_doubt;
  bool at_once = false;  // a stop waits: as in_doubt, and on every path under either policy

  FixedVector<PacketPlan, kPaths> plans(bool between, Instant now) const;

 private:
  struct Kind {
    bool only_safety = false, between = false;
  };
  PacketPlan plan(std::uint8_t paths, Kind kind, Instant now) const;
  std::size_t trial_room(PathId path) const;
  bool has_room(PathId path, bool between, Instant now) const;
  std::uint8_t apart(std::uint8_t paths, Instant now) const;
  PathId better(std::uint8_t paths) const;
};

}  // namespace pitwall::telemetry
