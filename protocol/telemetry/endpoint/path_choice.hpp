// On which paths the packets of a slot go, and to which of the peer's addresses.
//   invariants
//          kDuplicate: one packet on all paths that have room. kBest: safety on all, the rest on
//          the better one. A path whose peer must prove an address, or that has much less room than
//          the other, has a packet of its own
//          the token that proves an address goes to that address alone: on the slot the packet goes
//          to the address on trial, half a slot later to the proved one
//   out    no plan where no path has room
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

// Which class of content goes on which of two paths.
enum class PathPolicy : std::uint8_t {
  kDuplicate,  // everything on all paths that have room
  kBest        // safety on all, the rest on the better one
};

// Around a body: header and tag.
inline constexpr std::size_t kAround = kHeaderSize + kTagSize;
inline constexpr std::size_t kTokenSize = 8;  // of kPathProbe and kPathProof

constexpr bool has(std::uint8_t paths, PathId path) { return (paths & bit_of(path)) != 0; }

// A packet that may be made now.
struct PacketPlan {
  std::uint8_t paths = 0;       // it goes on these
  std::size_t safety_room = 0;  // bytes of body, if only safety is in it
  bool only_safety = false;     // all else goes another way
  bool between = false;         // half a slot later
  bool trial = false;           // to the address that has yet to prove itself
  std::size_t most = kMaxBody;  // that may go there
  double rate = 0.0;            // bytes per second, at present, of the narrowest of its paths
};

struct PathChoice {
  const Association& association;
  std::span<const PathLane> lanes;
  PathPolicy policy;
  bool in_doubt;         // what leaves may be lost: a packet between slots is worth its price
  bool at_once = false;  // so is one with a stop; on every path, whatever the policy

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
