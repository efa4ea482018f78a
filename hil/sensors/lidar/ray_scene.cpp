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
  const std::size_t number = ray.hit.instID[0];
  const Embree::Part& part = embree_->parts[number];
  const Vector3 normal = turned(part.axes, {ray.hit.Ng_x, ray.hit.Ng_y, ray.hit.Ng_z});
  return Meeting{
      .range_m = ray.ray.tfar,
      .cos_incidence = std::min(1.0, std::abs(dot(normal, along)) / std::sqrt(dot(normal, normal))),
      .reflectance = part.reflectance[ray.hit.geomID],
      .car = number == 0 ? std::nullopt : std::optional{number - 1}};
}

}  // namespace pitwall::sensors
