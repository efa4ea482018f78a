// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/spline/spiro_segment.hpp"

#include <algorithm>
#include <cmath>

namespace pitwall::raceline {
namespace {

constexpr std::array<double, 4> kNodes{0.18343464249564980, 0.52553240991632899,
                                       0.79666647741362674, 0.96028985649753623};
constexpr std::array<double, 4> kWeights{0.36268378337836198, 0.31370664587788729,
                                         0.22238103445337447, 0.10122853629037626};
constexpr double kTurnPerPiece_rad = 0.5;
constexpr double kPiecesMax = 64.0;

// An upper bound of the turn along the segment.
double turn_bound(const SpiroCoefficients& k) {
  return std::abs(k[0]) + std::abs(k[1]) / 4.0 + std::abs(k[2]) / 24.0 + std::abs(k[3]) / 192.0;
}

// fn(u, weight) at the nodes of a quadrature over [from, to].
template <class Fn>
void integrate_over(const SpiroCoefficients& k, double from_u, double to_u, Fn&& fn) {
  const double turn_rad = turn_bound(k) * std::abs(to_u - from_u);
  const double pieces = std::clamp(std::ceil(turn_rad / kTurnPerPiece_rad), 1.0, kPiecesMax);
  const double half_u = 0.5 * (to_u - from_u) / pieces;
  for (double piece = 0.0; piece < pieces; ++piece) {
    const double middle_u = from_u + (2.0 * piece + 1.0) * half_u;
    for (std::size_t i = 0; i < kNodes.size(); ++i) {
      fn(middle_u - kNodes[i] * half_u, kWeights[i] * half_u);
      fn(middle_u + kNodes[i] * half_u, kWeights[i] * half_u);
    }
  }
}

// d heading(u)/dk.
SpiroCoefficients heading_weights(double u) {
  return {u, u * u / 2.0, u * u * u / 6.0, u * u * u * u / 24.0};
}

double product(const SpiroCoefficients& a, const SpiroCoefficients& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < kSpiroOrder; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

SpiroCoefficients curvature_weights(double u, std::size_t order) {
  switch (order) {
    case 0:
      return {1.0, u, u * u / 2.0, u * u * u / 6.0};
    case 1:
      return {0.0, 1.0, u, u * u / 2.0};
    default:
      return {0.0, 0.0, 1.0, u};
  }
}

double heading_at(const SpiroCoefficients& k, double u) { return product(k, heading_weights(u)); }

double curvature_at(const SpiroCoefficients& k, double u, std::size_t order) {
  return product(k, curvature_weights(u, order));
}

Displacement displacement(const SpiroCoefficients& k, double from_u, double to_u) {
  Displacement d;
  integrate_over(k, from_u, to_u, [&](double u, double weight) {
    const double heading_rad = heading_at(k, u);
    d.x += weight * std::cos(heading_rad);
    d.y += weight * std::sin(heading_rad);
  });
  return d;
}

SegmentShape shape_of(const SpiroCoefficients& k) {
  Sensitive x, y;
  integrate_over(k, -0.5, 0.5, [&](double u, double weight) {
    const double heading_rad = heading_at(k, u);
    const SpiroCoefficients by_k = heading_weights(u);
    const double dx = weight * std::cos(heading_rad), dy = weight * std::sin(heading_rad);
    x.value += dx, y.value += dy;
    for (std::size_t i = 0; i < kSpiroOrder; ++i)
      x.by_k[i] -= dy * by_k[i], y.by_k[i] += dx * by_k[i];
  });
  const double chord = std::hypot(x.value, y.value), chord_rad = std::atan2(y.value, x.value);
  const SpiroCoefficients start = heading_weights(-0.5), end = heading_weights(0.5);
  SegmentShape shape{
      {chord, {}}, {product(k, start) - chord_rad, {}}, {product(k, end) - chord_rad, {}}};
  for (std::size_t i = 0; i < kSpiroOrder; ++i) {
    shape.chord.by_k[i] = (x.value * x.by_k[i] + y.value * y.by_k[i]) / chord;
    const double turn = (x.value * y.by_k[i] - y.value * x.by_k[i]) / (chord * chord);
    shape.start_heading.by_k[i] = start[i] - turn;
    shape.end_heading.by_k[i] = end[i] - turn;
  }
  return shape;
}

}  // namespace pitwall::raceline
