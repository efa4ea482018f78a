// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_map_file.hpp"

#include "protocol/transport/file.hpp"
#include "vehicle/parameters/track_file.hpp"

namespace pitwall::track_file {
namespace {

constexpr std::size_t kTrackFileBytes = std::size_t{16} << 20U;

}  // namespace

Result<world::TrackMap, Problem> read_track_map(const std::string& file) {
  const auto text = transport::read_file(file, kTrackFileBytes);
  if (!text) return Unexpected{text.error()};
  const auto description = parameters::read_track(*text, file);
  if (!description) return Unexpected{description.error()};
  return world::TrackMap::build(*description);
}

}  // namespace pitwall::track_file
