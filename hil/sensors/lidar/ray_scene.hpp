// What rays meet: surfaces that stand still, and cars that are placed anew for each ring of a
// sweep or each image.
//   frames Map
//   out    the first surface along a ray; whether something is in the way
//   law    the nearest of all triangles; of two at one distance either
//   errors none that a caller can make: a place beyond the cars is a CHECK
//   cost   about 1 us a ray, less in packets of neighbours; place() and commit() 20 us for some
//          cars
//   source Embree 3 (Wald et al., ACM TOG 33(4), 2014)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>

#include "hil/sensors/geometry.hpp"
#include "hil/sensors/lidar/mesh.hpp"

namespace pitwall::sensors {

struct Meeting {
  double range_m = 0.0;
  double cos_incidence = 0.0;  // of the angle to the surface's normal, in [0, 1]
  double reflectance = 0.0;
  std::optional<std::size_t> car{};  // unset: a surface that stands still
  std::size_t mesh = 0;              // which of those that were given together
  Vector3 normal{};                  // of length 1, on the ray's side
};

// Rays that lie together, as those of neighbouring pixels.
inline constexpr std::size_t kPacket = 8;
template <class T>
using Packet = std::array<T, kPacket>;

class RayScene {
 public:
  explicit RayScene(std::span<const Mesh> still);
  ~RayScene();
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;

  // Returns its number: 0, 1, ...
  std::size_t add_car(std::span<const Mesh> meshes);
  // Axes of another length than 1 stretch it.
  void place(std::size_t car, const Rotation& axes, const Vector3& at);
  void hide(std::size_t car);
  void commit();  // makes place() and hide() take effect

  // `along` has the length 1.
  std::optional<Meeting> first(const Vector3& from, const Vector3& along, double reach_m) const;
  Packet<std::optional<Meeting>> first(const Vector3& from, const Packet<Vector3>& along,
                                       double reach_m) const;
  // Of a place: whether a surface hides what lies `towards`, within 100 m. Those without a place
  // are not asked.
  Packet<bool> is_hidden(const Packet<std::optional<Vector3>>& places,
                         const Vector3& towards) const;

 private:
  struct Embree;
  struct Hit {
    std::size_t part = 0, mesh = 0;
    double range_m = 0.0;
    Vector3 normal{};  // of the part, of any length
  };
  Meeting meeting(const Hit& hit, const Vector3& along) const;

  std::unique_ptr<Embree> embree_;
};

}  // namespace pitwall::sensors
