// SPDX-License-Identifier: Apache-2.0
#include "hil/sensors/lidar/ray_scene.hpp"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::sensors {
namespace {

template <class T>
void copy_to(RTCGeometry geometry, RTCBufferType type, RTCFormat format,
             const std::vector<T>& rows) {
  void* const buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), rows.size());
  std::copy(rows.begin(), rows.end(), static_cast<T*>(buffer));
}

}  // namespace

struct RayScene::Embree {
  // An instance of a scene of its own, with the reflectance of each of its meshes.
  struct Part {
    RTCScene scene = nullptr;
    RTCGeometry instance = nullptr;
    std::vector<float> reflectance{};
    Rotation axes = rotation({});
  };

  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene world = rtcNewScene(device);
  std::vector<Part> parts;  // by the instance's number; first what stands still

  Embree() { rtcSetSceneFlags(world, RTC_SCENE_FLAG_DYNAMIC); }
  ~Embree() {
    for (const Part& part : parts) {
      rtcReleaseGeometry(part.instance);
      rtcReleaseScene(part.scene);
    }
    rtcReleaseScene(world);
    rtcReleaseDevice(device);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;

  void add(std::span<const Mesh> meshes) {
    Part part{.scene = rtcNewScene(device)};
    for (const Mesh& mesh : meshes) {
      RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
      copy_to(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh.corners);
      copy_to(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.triangles);
      rtcCommitGeometry(geometry);
      rtcAttachGeometryByID(part.scene, geometry,
                            static_cast<unsigned int>(part.reflectance.size()));
      rtcReleaseGeometry(geometry);
      part.reflectance.push_back(mesh.reflectance);
    }
    rtcCommitScene(part.scene);
    part.instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(part.instance, part.scene);
    rtcCommitGeometry(part.instance);
    rtcAttachGeometryByID(world, part.instance, static_cast<unsigned int>(parts.size()));
    parts.push_back(std::move(part));
  }

  Part& car(std::size_t number) {
    CHECK(number + 1 < parts.size());
    return parts[number + 1];
  }
};

RayScene::RayScene(std::span<const Mesh> still) : embree_(std::make_unique<Embree>()) {
  embree_->add(still);
  commit();
}
RayScene::~RayScene() = default;
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;

std::size_t RayScene::add_car(std::span<const Mesh> meshes) {
  embree_->add(meshes);
  return embree_->parts.size() - 2;
}

void RayScene::place(std::size_t car, const Rotation& axes, const Vector3& at) {
  std::array<float, 12> columns{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      columns[3 * axis + k] = static_cast<float>(axes[axis][k]);
    columns[9 + k] = static_cast<float>(at[k]);
  }
  embree_->car(car).axes = axes;
  RTCGeometry instance = embree_->car(car).instance;
  rtcSetGeometryTransform(instance, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
  rtcEnableGeometry(instance);
  rtcCommitGeometry(instance);
}

void RayScene::hide(std::size_t car) {
  rtcDisableGeometry(embree_->car(car).instance);
  rtcCommitGeometry(embree_->car(car).instance);
}

void RayScene::commit() { rtcCommitScene(embree_->world); }

Meeting RayScene::meeting(const Hit& hit, const Vector3& along) const {
  const Embree::Part& part = embree_->parts[hit.part];
  Vector3 normal = turned(part.axes, hit.normal);
  normal = times(1.0 / std::sqrt(dot(normal, normal)), normal);
  const double cosine = dot(normal, along);
  return Meeting{.range_m = hit.range_m,
                 .cos_incidence = std::min(1.0, std::abs(cosine)),
                 .reflectance = part.reflectance[hit.mesh],
                 .car = hit.part == 0 ? std::nullopt : std::optional{hit.part - 1},
                 .mesh = hit.mesh,
                 .normal = cosine > 0.0 ? times(-1.0, normal) : normal};
}

std::optional<Meeting> RayScene::first(const Vector3& from, const Vector3& along,
                                       double reach_m) const {
  RTCRayHit ray{};
  ray.ray.org_x = static_cast<float>(from[0]), ray.ray.dir_x = static_cast<float>(along[0]);
  ray.ray.org_y = static_cast<float>(from[1]), ray.ray.dir_y = static_cast<float>(along[1]);
  ray.ray.org_z = static_cast<float>(from[2]), ray.ray.dir_z = static_cast<float>(along[2]);
  ray.ray.tfar = static_cast<float>(reach_m), ray.ray.mask = ~0U;
  ray.hit.geomID = ray.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(embree_->world, &context, &ray);
  if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  return meeting({.part = ray.hit.instID[0],
                  .mesh = ray.hit.geomID,
                  .range_m = ray.ray.tfar,
                  .normal = {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z}},
                 along);
}

Packet<std::optional<Meeting>> RayScene::first(const Vector3& from, const Packet<Vector3>& along,
                                               double reach_m) const {
  RTCRayHit8 rays{};
  alignas(32) Packet<int> asked;
  asked.fill(-1);
  for (std::size_t k = 0; k < kPacket; ++k) {
    rays.ray.org_x[k] = static_cast<float>(from[0]);
    rays.ray.org_y[k] = static_cast<float>(from[1]);
    rays.ray.org_z[k] = static_cast<float>(from[2]);
    rays.ray.dir_x[k] = static_cast<float>(along[k][0]);
    rays.ray.dir_y[k] = static_cast<float>(along[k][1]);
    rays.ray.dir_z[k] = static_cast<float>(along[k][2]);
    rays.ray.tfar[k] = static_cast<float>(reach_m), rays.ray.mask[k] = ~0U;
    rays.hit.geomID[k] = rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(asked.data(), embree_->world, &context, &rays);
  Packet<std::optional<Meeting>> met{};
  for (std::size_t k = 0; k < kPacket; ++k)
    if (rays.hit.geomID[k] != RTC_INVALID_GEOMETRY_ID)
      met[k] = meeting({.part = rays.hit.instID[0][k],
                        .mesh = rays.hit.geomID[k],
                        .range_m = rays.ray.tfar[k],
                        .normal = {rays.hit.Ng_x[k], rays.hit.Ng_y[k], rays.hit.Ng_z[k]}},
                       along[k]);
  return met;
}

Packet<bool> RayScene::is_hidden(const Packet<std::optional<Vector3>>& places,
                                 const Vector3& towards) const {
  constexpr float kOff_m = 0.02F, kReach_m = 100.0F;
  RTCRay8 rays{};
  alignas(32) Packet<int> asked{};
  for (std::size_t k = 0; k < kPacket; ++k) {
    if (!places[k]) continue;
    asked[k] = -1;
    rays.org_x[k] = static_cast<float>((*places[k])[0]);
    rays.org_y[k] = static_cast<float>((*places[k])[1]);
    rays.org_z[k] = static_cast<float>((*places[k])[2]);
    rays.dir_x[k] = static_cast<float>(towards[0]);
    rays.dir_y[k] = static_cast<float>(towards[1]);
    rays.dir_z[k] = static_cast<float>(towards[2]);
    rays.tnear[k] = kOff_m, rays.tfar[k] = kReach_m, rays.mask[k] = ~0U;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded8(asked.data(), embree_->world, &context, &rays);
  Packet<bool> hidden{};
  for (std::size_t k = 0; k < kPacket; ++k) hidden[k] = places[k] && rays.tfar[k] < 0.0F;
  return hidden;
}

}  // namespace pitwall::sensors
