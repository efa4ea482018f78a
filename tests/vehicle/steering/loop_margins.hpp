// Margins of a stable loop from its open-loop frequency response: gain up and down, phase, delay,
// and the peak of the sensitivity.
//   in     the response as a function of the frequency, negative feedback; highest frequency
//   out    Margins; infinite (gain_down: 0) if there is no limit
//   source Astrom, Murray, Feedback Systems, 2nd ed., sec. 10.3 and 13.2 (sensitivity)
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

namespace pitwall::steering::testing {

struct Margins {
  double phase_rad = std::numeric_limits<double>::infinity();
  double gain_up = std::numeric_limits<double>::infinity(), gain_down = 0.0;  // factors
  double delay_s = std::numeric_limits<double>::infinity();
  double sensitivity = 0.0;  // largest |1 / (1 + L)|
};

// Frequency between the two at which f changes its sign.
template <class Fn>
double crossing(Fn f, double low, double high) {
  const bool rises = f(low) < 0.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    ((f(middle) < 0.0) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

template <class Fn>
double largest(Fn f, double low, double high) {
  for (int i = 0; i < 30; ++i) {
    const double third = (high - low) / 3.0;
    if (f(low + third) < f(high - third))
      low += third;
    else
      high -= third;
  }
  return f(0.5 * (low + high));
}

template <class Response>
Margins margins_of(Response loop, double highest_rad_per_s) {
  constexpr int kPoints = 400;
  constexpr double kLowest_rad_per_s = 0.005;
  const auto frequency = [&](int i) {
    return kLowest_rad_per_s *
           std::pow(highest_rad_per_s / kLowest_rad_per_s, static_cast<double>(i) / (kPoints - 1));
  };
  const auto excess = [&](double w) { return std::abs(loop(w)) - 1.0; };
  const auto imaginary = [&](double w) { return loop(w).imag(); };
  const auto sensitivity = [&](double w) { return 1.0 / std::abs(1.0 + loop(w)); };
  Margins out;
  int peak = 0;
  std::complex<double> before = loop(frequency(0));
  for (int i = 1; i < kPoints; ++i) {
    const std::complex<double> now = loop(frequency(i));
    if ((std::abs(before) < 1.0) != (std::abs(now) < 1.0)) {
      const double w = crossing(excess, frequency(i - 1), frequency(i));
      // The lag to -180 degrees, and the lead to +180.
      const double lag = std::arg(-loop(w));
      const double whole = 2.0 * std::numbers::pi;
      out.phase_rad = std::min(out.phase_rad, std::abs(lag));
      out.delay_s = std::min(out.delay_s, (lag < 0.0 ? lag + whole : lag) / w);
    }
    if ((before.imag() < 0.0) != (now.imag() < 0.0) && before.real() < 0.0 && now.real() < 0.0) {
      const double factor =
          1.0 / std::abs(loop(crossing(imaginary, frequency(i - 1), frequency(i))));
      if (factor > 1.0)
        out.gain_up = std::min(out.gain_up, factor);
      else
        out.gain_down = std::max(out.gain_down, factor);
    }
    const double inverse = 1.0 / std::abs(1.0 + now);
    if (inverse > out.sensitivity) out.sensitivity = inverse, peak = i;
    before = now;
  }
  out.sensitivity = largest(sensitivity, frequency(std::max(peak - 1, 0)),
                            frequency(std::min(peak + 1, kPoints - 1)));
  return out;
}

}  // namespace pitwall::steering::testing
