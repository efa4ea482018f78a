// Parameters of the two tracking filters with their legal ranges.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "vehicle/world/legal_range.hpp"

namespace pitwall::tracking {

// The method "road": noise of the motion and of the sensors, gates.
struct RoadParams {
  // Acceleration and turn rate are noise that is forgotten in a time. Sigma and time are those of a
  // steady car, whose acceleration changes slowly, or of one that begins to brake, to speed up or
  // to change its lane; one that changes only its speed turns less.
  double steady_accel_sigma_mps2 = 0.45, steady_accel_time_s = 10.0;
  double accel_sigma_mps2 = 4.0, accel_time_s = 1.6;
  double steady_turn_sigma_rad_per_s = 0.0045, speed_change_turn_sigma_rad_per_s = 0.0125;
  double turn_sigma_rad_per_s = 0.033, turn_time_s = 0.6;
  // With a map a car comes back to the direction of the road in this time.
  double heading_time_s = 1.4;
  double steady_s = 16.0, maneuver_s = 7.0;  // mean lengths
  double speed_change_share = 0.6;           // of the maneuvers; the others change the lane too
  // The same without a map, where the turn rate is that of the road too.
  double plane_turn_sigma_rad_per_s = 0.3, plane_turn_time_s = 5.0;
  // What the model of the motion leaves out.
  double wander_m_per_sqrt_s = 0.05, heading_wander_rad_per_sqrt_s = 0.003;
  // Of a new track, about our own speed and the direction of the road (of our car on a plane).
  double start_speed_sigma_mps = 40.0, start_heading_sigma_rad = 0.15;
  // Grows beyond a distance: 0.30 m at 100 m.
  double lidar_sigma_m = 0.15, lidar_sigma_from_m = 60.0, lidar_sigma_per_m = 0.00375;
  double lidar_yaw_sigma_rad = 0.035;
  // Camera 0, the narrow one, and the wide ones. Of the depth, the sigma of the height of the image
  // by focal length and height of the car: 1 and 1.5 pixels.
  double camera_bearing_sigma_rad = 0.001, wide_camera_bearing_sigma_rad = 0.003;
  double camera_inverse_depth_sigma_per_m = 0.00042;
  double wide_camera_inverse_depth_sigma_per_m = 0.0014;
  double radar_range_sigma_m = 0.5, radar_bearing_sigma_rad = 0.0175;
  // 0.15 m/s, and the error of our own speed of 0.05 m/s, which is the same for some 40 of them.
  double radar_rate_sigma_mps = 0.3;
  // Chi-square gates by the number of values; these let 1 of 100000 good ones out. More would leave
  // where two modes are one normal distribution.
  double gate_1 = 19.51, gate_2 = 23.03, gate_3 = 25.90;
  double apart_m = 1.8;  // closer to a confirmed track no track begins
  // Of a car that is out of sight (courses.hpp): its acceleration, how long it may have it; its
  // speed across the road in a change of lanes, and for how long; how often it has an acceleration,
  // and how often it changes its lane; sigma across the road of one that keeps it, as a share.
  double unseen_accel_sigma_mps2 = 2.5, unseen_accel_s = 3.0;
  double unseen_lane_sigma_mps = 1.5, unseen_lane_s = 2.0;
  double other_speed_share = 0.2, other_lane_share = 0.2, lane_sigma_share = 0.5;
  double same_car_gate = 33.1;  // chi-square of six states
  // So long a car is known when it is seen again. After coast_s it then has a new number: no other
  // car gets the number of one that may have come to its place.
  double remembered_s = 30.0;
  double size_share = 0.02;  // of a detection in the size, after the first 1 / size_share
};

inline constexpr auto kRoadRanges = std::to_array<world::NamedRange<RoadParams>>({
    {"steady_accel_sigma_mps2", &RoadParams::steady_accel_sigma_mps2, 0.01, 20.0},
    {"steady_accel_time_s", &RoadParams::steady_accel_time_s, 0.1, 100.0},
    {"accel_sigma_mps2", &RoadParams::accel_sigma_mps2, 0.1, 20.0},
    {"accel_time_s", &RoadParams::accel_time_s, 0.1, 20.0},
    {"steady_turn_sigma_rad_per_s", &RoadParams::steady_turn_sigma_rad_per_s, 1e-4, 1.0},
    {"speed_change_turn_sigma_rad_per_s", &RoadParams::speed_change_turn_sigma_rad_per_s, 1e-4,
     1.0},
    {"turn_sigma_rad_per_s", &RoadParams::turn_sigma_rad_per_s, 0.001, 1.0},
    {"turn_time_s", &RoadParams::turn_time_s, 0.1, 20.0},
    {"heading_time_s", &RoadParams::heading_time_s, 0.1, 1000.0},
    {"steady_s", &RoadParams::steady_s, 0.1, 1000.0},
    {"maneuver_s", &RoadParams::maneuver_s, 0.1, 1000.0},
    {"speed_change_share", &RoadParams::speed_change_share, 0.01, 0.99},
    {"plane_turn_sigma_rad_per_s", &RoadParams::plane_turn_sigma_rad_per_s, 0.001, 2.0},
    {"plane_turn_time_s", &RoadParams::plane_turn_time_s, 0.1, 60.0},
    {"wander_m_per_sqrt_s", &RoadParams::wander_m_per_sqrt_s, 0.0, 2.0},
    {"heading_wander_rad_per_sqrt_s", &RoadParams::heading_wander_rad_per_sqrt_s, 0.0, 0.1},
    {"start_speed_sigma_mps", &RoadParams::start_speed_sigma_mps, 1.0, 100.0},
    {"start_heading_sigma_rad", &RoadParams::start_heading_sigma_rad, 0.01, 1.5},
    {"lidar_sigma_m", &RoadParams::lidar_sigma_m, 0.01, 2.0},
    {"lidar_sigma_from_m", &RoadParams::lidar_sigma_from_m, 0.0, 300.0},
    {"lidar_sigma_per_m", &RoadParams::lidar_sigma_per_m, 0.0, 0.05},
    {"lidar_yaw_sigma_rad", &RoadParams::lidar_yaw_sigma_rad, 0.005, 0.5},
    {"camera_bearing_sigma_rad", &RoadParams::camera_bearing_sigma_rad, 0.0002, 0.1},
    {"wide_camera_bearing_sigma_rad", &RoadParams::wide_camera_bearing_sigma_rad, 0.0002, 0.1},
    {"wide_camera_inverse_depth_sigma_per_m", &RoadParams::wide_camera_inverse_depth_sigma_per_m,
     1e-5, 0.02},
    {"camera_inverse_depth_sigma_per_m", &RoadParams::camera_inverse_depth_sigma_per_m, 1e-5, 0.02},
    {"radar_range_sigma_m", &RoadParams::radar_range_sigma_m, 0.02, 5.0},
    {"radar_bearing_sigma_rad", &RoadParams::radar_bearing_sigma_rad, 0.0005, 0.2},
    {"radar_rate_sigma_mps", &RoadParams::radar_rate_sigma_mps, 0.02, 5.0},
    {"gate_1", &RoadParams::gate_1, 3.0, 50.0},
    {"gate_2", &RoadParams::gate_2, 4.0, 50.0},
    {"gate_3", &RoadParams::gate_3, 5.0, 50.0},
    {"apart_m", &RoadParams::apart_m, 0.0, 5.0},
    {"unseen_accel_sigma_mps2", &RoadParams::unseen_accel_sigma_mps2, 0.0, 10.0},
    {"unseen_accel_s", &RoadParams::unseen_accel_s, 0.0, 20.0},
    {"unseen_lane_sigma_mps", &RoadParams::unseen_lane_sigma_mps, 0.0, 10.0},
    {"unseen_lane_s", &RoadParams::unseen_lane_s, 0.0, 20.0},
    {"same_car_gate", &RoadParams::same_car_gate, 5.0, 100.0},
    {"other_speed_share", &RoadParams::other_speed_share, 0.001, 0.999},
    {"other_lane_share", &RoadParams::other_lane_share, 0.001, 0.999},
    {"lane_sigma_share", &RoadParams::lane_sigma_share, 0.05, 1.0},
    {"remembered_s", &RoadParams::remembered_s, 0.0, 60.0},
    {"size_share", &RoadParams::size_share, 0.001, 1.0},
});

// The method "paper": AB3DMOT's Kalman filter, whose own values are per frame of 0.1 s (KITTI).
// In seconds its velocities are ten times and their variances a hundred times as large.
struct PaperParams {
  double measurement_variance = 1.0;      // R, of every value
  double start_variance = 10.0;           // P of x, y, yaw, length, width
  double start_speed_variance = 1e6;      // P of vx, vy: 10 * 1000 (m / 0.1 s)^2
  double variance_per_frame = 1.0;        // Q of x, y, yaw, length, width
  double speed_variance_per_frame = 1.0;  // Q of vx, vy: 0.01 (m / 0.1 s)^2
  double frame_s = 0.1;                   // to which both belong
  double gate = 11.0;                     // of the squared Mahalanobis distance
};

inline constexpr auto kPaperRanges = std::to_array<world::NamedRange<PaperParams>>({
    {"measurement_variance", &PaperParams::measurement_variance, 1e-4, 100.0},
    {"start_variance", &PaperParams::start_variance, 1e-4, 1e4},
    {"start_speed_variance", &PaperParams::start_speed_variance, 1e-2, 1e8},
    {"variance_per_frame", &PaperParams::variance_per_frame, 1e-6, 100.0},
    {"speed_variance_per_frame", &PaperParams::speed_variance_per_frame, 1e-6, 1e4},
    {"frame_s", &PaperParams::frame_s, 0.005, 1.0},
    {"gate", &PaperParams::gate, 1.0, 200.0},
});

}  // namespace pitwall::tracking
