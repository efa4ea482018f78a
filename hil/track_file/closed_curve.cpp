// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/closed_curve.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "protocol/vocabulary/check.hpp"

namespace pitwall::track_file {
namespace {

using Complex = std::complex<double>;  // x + i y: one series for both

constexpr double kStep_m = 1.0;
constexpr std::size_t kStepsMin = 64;
constexpr int kOrder = 6;
constexpr double kHarmonicsOverCutoff = 3.2;  // beyond it a harmonic keeps less than 0.1 %
constexpr double kTurn_rad = 2.0 * std::numbers::pi;

Complex complex_of(const Place& p) { return {p.x_m, p.y_m}; }

// Equal steps along the chords, by cubic Hermite pieces whose slopes are those of the parabolas
// through three neighbours: a chord alone would cut every turn.
std::vector<Complex> resampled(const std::vector<Place>& points, std::size_t steps) {
  const std::vector<double> at_m = chord_lengths(points);
  const std::size_t n = points.size();
  const auto place = [&](std::size_t j) { return complex_of(points[j % n]); };
  const auto gap_m = [&](std::size_t j) { return at_m[j % n + 1] - at_m[j % n]; };
  const auto secant = [&](std::size_t j) { return (place(j + 1) - place(j)) / gap_m(j); };
  const auto slope = [&](std::size_t j) {
    const std::size_t before = (j + n - 1) % n;
    return (secant(j) * gap_m(before) + secant(before) * gap_m(j)) / (gap_m(j) + gap_m(before));
  };
  std::vector<Complex> out(steps);
  std::size_t j = 0;
  for (std::size_t i = 0; i < steps; ++i) {
    const double along_m = at_m.back() * static_cast<double>(i) / static_cast<double>(steps);
    while (j + 1 < n && at_m[j + 1] <= along_m) ++j;
    const double h_m = gap_m(j), t = (along_m - at_m[j]) / h_m, r = 1.0 - t;
    out[i] = place(j) * (r * r * (1.0 + 2.0 * t)) + place(j + 1) * (t * t * (3.0 - 2.0 * t)) +
             h_m * (slope(j) * (t * r * r) - slope(j + 1) * (t * t * r));
  }
  return out;
}

struct Smoothed {
  std::vector<Complex> place, slope;  // slope per metre along the chords
};

// Positive and negative harmonics of x + i y apart; the constant is the middle of the curve.
Smoothed low_pass(const std::vector<Complex>& in, double length_m, double cutoff_m) {
  const std::size_t n = in.size();
  const double cutoff = length_m / cutoff_m;
  const auto harmonics =
      std::min((n - 1) / 2,
               static_cast<std::size_t>(std::ceil(std::max(kHarmonicsOverCutoff * cutoff, 3.0))));
  Complex middle = 0.0;
  for (const Complex& p : in) middle += p / static_cast<double>(n);
  Smoothed out{std::vector<Complex>(n, middle), std::vector<Complex>(n, 0.0)};
  for (std::size_t k = 1; k <= harmonics; ++k)
    for (const double sign : {1.0, -1.0}) {
      const double order = sign * static_cast<double>(k);
      const Complex turn = std::polar(1.0, kTurn_rad * order / static_cast<double>(n));
      Complex coefficient = 0.0, wave = 1.0;
      for (std::size_t i = 0; i < n; ++i, wave *= turn) coefficient += in[i] * std::conj(wave);
      coefficient /=
          static_cast<double>(n) * (1.0 + std::pow(static_cast<double>(k) / cutoff, kOrder));
      const Complex rate{0.0, kTurn_rad * order / length_m};
      wave = coefficient;
      for (std::size_t i = 0; i < n; ++i, wave *= turn) {
        out.place[i] += wave;
        out.slope[i] += wave * rate;
      }
    }
  return out;
}

}  // namespace

std::vector<double> chord_lengths(const std::vector<Place>& points) {
  std::vector<double> at_m{0.0};
  for (std::size_t j = 0; j < points.size(); ++j) {
    const Complex a = complex_of(points[j]), b = complex_of(points[(j + 1) % points.size()]);
    at_m.push_back(at_m.back() + std::abs(b - a));
  }
  return at_m;
}

ClosedCurve smooth_curve(const std::vector<Place>& points, double cutoff_m) {
  CHECK(points.size() >= 3 && cutoff_m > 0.0);
  const double length_m = chord_lengths(points).back();
  const std::size_t n =
      std::max(kStepsMin, static_cast<std::size_t>(std::ceil(length_m / kStep_m)));
  const double step_m = length_m / static_cast<double>(n);
  const Smoothed smooth = low_pass(resampled(points, n), length_m, cutoff_m);
  ClosedCurve curve;
  curve.points.reserve(n + 1);
  double s_m = 0.0, yaw_rad = std::arg(smooth.slope[0]);
  for (std::size_t i = 0; i <= n; ++i) {
    const Complex p = smooth.place[i % n], slope = smooth.slope[i % n];
    if (i > 0) {
      // The mean of a periodic smooth function by its samples: exact but for rounding over a lap.
      s_m += 0.5 * step_m * (std::abs(slope) + std::abs(smooth.slope[i - 1]));
      yaw_rad += std::arg(slope / smooth.slope[i - 1]);
    }
    curve.points.push_back({static_cast<double>(i) * step_m, s_m, p.real(), p.imag(), yaw_rad});
  }
  return curve;
}

}  // namespace pitwall::track_file
