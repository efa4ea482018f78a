// SPDX-License-Identifier: Apache-2.0
#include "protocol/telemetry/delivery/path_object.hpp"

#include <cmath>

#include "protocol/vocabulary/bytes.hpp"

namespace pitwall::telemetry {
namespace {

constexpr std::uint8_t kVersion = 1;
constexpr double kPerMetre = 100.0;

bool is_fit(const PathPoint& p) {
  return std::abs(p.x_m) <= kPathReach_m && std::abs(p.y_m) <= kPathReach_m && p.speed_mps >= 0.0 &&
         p.speed_mps <= kPathSpeed_mps;  // false for NaN
}

std::int32_t centi(double value) {
  return static_cast<std::int32_t>(std::lround(value * kPerMetre));
}

struct Place {
  std::int32_t x = 0, y = 0;
};

bool is_near(Place a, Place b) {
  const std::int32_t step = centi(kPathStep_m);
  return std::abs(a.x - b.x) <= step && std::abs(a.y - b.y) <= step;
}

template <class T, class Value>
void put(std::span<std::uint8_t> bytes, std::size_t& at, Value value) {
  store(bytes, at, static_cast<T>(value));
  at += sizeof(T);
}

template <class T>
T take(std::span<const std::uint8_t> bytes, std::size_t& at) {
  const T value = load<T>(bytes, at);
  at += sizeof(T);
  return value;
}

PathPoint point_of(Place place, std::uint16_t speed) {
  return {place.x / kPerMetre, place.y / kPerMetre, speed / kPerMetre};
}

}  // namespace

std::optional<std::span<const std::uint8_t>> encode_path(std::span<const PathPoint> points,
                                                         PathBuffer& buffer) {
  if (points.empty() || points.size() > kPathPoints) return std::nullopt;
  std::size_t at = 0;
  put<std::uint8_t>(buffer, at, kVersion);
  put<std::uint16_t>(buffer, at, points.size());
  Place last;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!is_fit(points[i])) return std::nullopt;
    const Place place{centi(points[i].x_m), centi(points[i].y_m)};
    if (i == 0) {
      put<std::uint32_t>(buffer, at, place.x);
      put<std::uint32_t>(buffer, at, place.y);
    } else {
      if (!is_near(place, last)) return std::nullopt;
      put<std::uint16_t>(buffer, at, place.x - last.x);
      put<std::uint16_t>(buffer, at, place.y - last.y);
    }
    put<std::uint16_t>(buffer, at, centi(points[i].speed_mps));
    last = place;
  }
  return std::span<const std::uint8_t>(buffer).first(at);
}

std::optional<Path> decode_path(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kPathHead + kPathFirst || bytes[0] != kVersion) return std::nullopt;
  std::size_t at = 1;
  const std::size_t count = take<std::uint16_t>(bytes, at);
  if (count == 0 || count > kPathPoints) return std::nullopt;
  if (bytes.size() != kPathHead + kPathFirst + (count - 1) * kPathLater) return std::nullopt;
  Place place{static_cast<std::int32_t>(take<std::uint32_t>(bytes, at)),
              static_cast<std::int32_t>(take<std::uint32_t>(bytes, at))};
  constexpr auto kReach = static_cast<std::int64_t>(kPathReach_m * kPerMetre);
  const auto is_on_the_map = [](std::int32_t v) { return v >= -kReach && v <= kReach; };
  if (!is_on_the_map(place.x) || !is_on_the_map(place.y)) return std::nullopt;
  Path path;
  for (std::size_t i = 0; i < count; ++i) {
    if (i > 0) {
      place.x += static_cast<std::int16_t>(take<std::uint16_t>(bytes, at));
      place.y += static_cast<std::int16_t>(take<std::uint16_t>(bytes, at));
    }
    static_cast<void>(path.push(point_of(place, take<std::uint16_t>(bytes, at))));
  }
  return path;
}

}  // namespace pitwall::telemetry
