// Exchange of group lists between two ends whose telemetry registries differ. Each end sends the
// list of groups that its packets may hold; the other end reads the groups that both registries
// have and skips the rest.
//   wire   kSchema: have u8 (1: the peer's list is complete here), total u8, first u8, then for
//          each place from the first on: hash u32 (low half of the group's), bits u16
//   out    the layout of the peer's packets; which of our groups may be sent
//   invariants
//          no list is sent while both registries are the same. Otherwise no group is sent before
//          the peer has the whole list. Two groups with different hashes are different groups, even
//          under the same name
//   cost   no allocation
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string_view>

#include "protocol/telemetry/packet/body.hpp"

namespace pitwall::telemetry {

// Description of one end's registry. Tests build descriptions of other versions.
struct SchemaDescription {
  struct Place {
    std::uint32_t hash = 0;
    GroupPlace group;
  };
  using Places = FixedVector<Place, kMaxPlaces>;

  Places down, up;  // in the order of the bits of the set
  std::uint64_t safety_hash = 0, whole_hash = 0;
  std::string_view safety_text;  // empty: the text of the registry

  const Places& of(Direction direction) const { return direction == Direction::kDown ? down : up; }
};
const SchemaDescription& own_schema();

class SchemaExchange {
 public:
  SchemaExchange(const SchemaDescription& own, Direction sends);

  // Starts a session with a peer whose registry has this hash.
  void begin(std::uint64_t peer_whole_hash);
  bool take(std::span<const std::uint8_t> payload);
  std::size_t size() const;  // bytes of the record in the next packet
  void write(BodyWriter& body);

  const Layout& sending() const { return sending_; }
  const Layout& reading() const { return reading_; }
  bool may_send() const { return !differs_ || peer_has_ours_; }

 private:
  static constexpr std::size_t kHead = 3, kEntry = 6, kPerRecord = 12;

  const SchemaDescription* own_;
  Direction sends_;
  Layout sending_, own_reading_, reading_;
  bool differs_ = false, peer_has_ours_ = false;
  std::size_t next_ = 0;        // first place of the next record
  std::uint8_t total_ = 0;      // number of places of the peer; 0: not yet received
  std::uint64_t received_ = 0;  // bit k: place k
  std::array<GroupPlace, kMaxPlaces> places_{};

  bool complete() const;
};

}  // namespace pitwall::telemetry
