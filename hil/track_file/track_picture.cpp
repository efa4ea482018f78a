// SPDX-License-Identifier: Apache-2.0
#include "hil/track_file/track_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "hil/report/text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::track_file {
namespace {

using world::TrackMap;
using world::TrackPoint;

constexpr double kWidth_px = 1280.0, kHeight_px = 800.0;
constexpr double kMargin_px = 70.0, kHead_px = 60.0, kFoot_px = 60.0;
constexpr double kPiece_m = 6.0;  // of road in one colour
constexpr double kStationStep_m = 100.0;
constexpr double kTick_px = 7.0;
constexpr double kDigit_px = 7.7, kHalfLine_px = 6.0;  // of the stations' numbers

// From level to steep: dark to light, readable without colour vision.
struct Colour {
  double red, green, blue;
};
constexpr std::array kScale{Colour{59, 76, 128}, Colour{45, 130, 142}, Colour{94, 190, 120},
                            Colour{222, 214, 88}, Colour{240, 140, 60}};

std::string colour_of(double share) {
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(kScale.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(place), kScale.size() - 2);
  const double t = place - static_cast<double>(low);
  const auto mix = [t](double a, double b) {
    return static_cast<int>(std::lround(a + (b - a) * t));
  };
  const Colour &a = kScale[low], &b = kScale[low + 1];
  return formatted("#%02x%02x%02x", mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue));
}

struct Pixel {
  double x = 0.0, y = 0.0;
};

class Picture {
 public:
  explicit Picture(const TrackMap& track) : track_(track) {
    const auto count = static_cast<std::size_t>(std::ceil(track.length_m() / kPiece_m));
    for (std::size_t i = 0; i < count; ++i)
      at_.push_back(
          track.at(track.length_m() * static_cast<double>(i) / static_cast<double>(count)));
    measure();
  }

  std::string draw() {
    out_ = formatted(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
        "viewBox=\"0 0 %.0f %.0f\" font-family=\"DejaVu Sans, sans-serif\" font-size=\"12\">\n",
        kWidth_px, kHeight_px, kWidth_px, kHeight_px);
    out_ += "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n";
    road();
    line(1.0, "wall", "stroke=\"#202020\" stroke-width=\"1.2\"");
    line(-1.0, "wall", "stroke=\"#202020\" stroke-width=\"1.2\"");
    line(0.0, "reference", "stroke=\"#ffffff\" stroke-width=\"1.4\" stroke-dasharray=\"6 4\"");
    stations();
    pit();
    start();
    legend();
    scale_bar();
    north();
    words();
    return out_ + "</svg>\n";
  }

 private:
  void measure() {
    double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
    for (const TrackPoint& p : at_)
      for (const double n_m : {p.width_left_m, -p.width_right_m}) {
        const double x_m = p.x_m - n_m * std::sin(p.yaw_rad);
        const double y_m = p.y_m + n_m * std::cos(p.yaw_rad);
        low_x = std::min(low_x, x_m), high_x = std::max(high_x, x_m);
        low_y = std::min(low_y, y_m), high_y = std::max(high_y, y_m);
        bank_low_ = std::min(bank_low_, p.bank_rad), bank_high_ = std::max(bank_high_, p.bank_rad);
      }
    px_per_m_ = std::min((kWidth_px - 2.0 * kMargin_px) / (high_x - low_x),
                         (kHeight_px - kHead_px - kFoot_px - kMargin_px) / (high_y - low_y));
    middle_ = {0.5 * (low_x + high_x), 0.5 * (low_y + high_y)};
  }

  Pixel at(double x_m, double y_m) const {
    return {0.5 * kWidth_px + (x_m - middle_.x) * px_per_m_,
            0.5 * (kHeight_px + kHead_px - kFoot_px) - (y_m - middle_.y) * px_per_m_};
  }
  Pixel beside(const TrackPoint& p, double n_m) const {
    return at(p.x_m - n_m * std::sin(p.yaw_rad), p.y_m + n_m * std::cos(p.yaw_rad));
  }
  static std::string coordinates(const Pixel& p) { return formatted("%.1f,%.1f ", p.x, p.y); }
  double bank_share(double bank_rad) const {
    const double range_rad = bank_high_ - bank_low_;
    return range_rad > from_deg(0.1) ? (bank_rad - bank_low_) / range_rad : 0.0;
  }

  void text(const Pixel& p, const std::string& words, const char* style = "") {
    out_ += formatted("<text x=\"%.1f\" y=\"%.1f\" %s>", p.x, p.y, style) + words + "</text>\n";
  }

  void road() {
    out_ += "<g class=\"road\">\n";
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const TrackPoint &a = at_[i], &b = at_[(i + 1) % at_.size()];
      const std::string fill = colour_of(bank_share(0.5 * (a.bank_rad + b.bank_rad)));
      out_ += "<polygon points=\"" + coordinates(beside(a, a.width_left_m)) +
              coordinates(beside(b, b.width_left_m)) + coordinates(beside(b, -b.width_right_m)) +
              coordinates(beside(a, -a.width_right_m)) +
              formatted("\" fill=\"%s\" stroke=\"%s\" stroke-width=\"0.4\"/>\n", fill.c_str(),
                        fill.c_str());
    }
    out_ += "</g>\n";
  }

  // side 1: left wall, -1: right wall, 0: the reference line
  void line(double side, const char* name, const char* style) {
    out_ += formatted("<polygon class=\"%s\" fill=\"none\" %s points=\"", name, style);
    for (const TrackPoint& p : at_) {
      const double n_m = side > 0.0 ? p.width_left_m : side < 0.0 ? -p.width_right_m : 0.0;
      out_ += coordinates(beside(p, n_m));
    }
    out_ += "\"/>\n";
  }

  // Outside of the lap: to the right on a left-hand track.
  double outward() const {
    double area_m2 = 0.0;
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const TrackPoint &a = at_[i], &b = at_[(i + 1) % at_.size()];
      area_m2 += a.x_m * b.y_m - b.x_m * a.y_m;
    }
    return area_m2 > 0.0 ? -1.0 : 1.0;
  }

  Pixel outside(const TrackPoint& p, double px) const {
    const double side = outward();
    const double wall_m = side > 0.0 ? p.width_left_m : p.width_right_m;
    return beside(p, side * (wall_m + px / px_per_m_));
  }

  void stations() {
    out_ += "<g class=\"stations\" fill=\"#303030\" stroke=\"none\">\n";
    // A label each 100 m where there is room for it, else each 200 m, 500 m, ...
    double label_m = kStationStep_m;
    for (const double more : {2.0, 5.0, 10.0, 20.0, 50.0})
      if (label_m * px_per_m_ < 30.0) label_m = kStationStep_m * more;
    for (double s_m = 0.0; s_m < track_.length_m(); s_m += kStationStep_m) {
      const TrackPoint p = track_.at(s_m);
      const Pixel a = outside(p, 0.0), b = outside(p, kTick_px);
      out_ +=
          formatted("<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#303030\"/>\n",
                    a.x, a.y, b.x, b.y);
      if (std::remainder(s_m, label_m) != 0.0 || track_.length_m() - s_m < 0.4 * label_m) continue;
      const std::string number = formatted("%.0f", s_m);
      const double half_px = 0.5 * kDigit_px * static_cast<double>(number.size());
      const double sideways = std::abs(b.x - a.x) / kTick_px;
      const Pixel words = outside(p, kTick_px + 3.0 + std::lerp(kHalfLine_px, half_px, sideways));
      text({words.x, words.y + 4.0}, number, "text-anchor=\"middle\"");
    }
    out_ += "</g>\n";
  }

  void across(const TrackPoint& p, const char* name, const char* style) {
    const Pixel a = beside(p, p.width_left_m), b = beside(p, -p.width_right_m);
    out_ += formatted("<line class=\"%s\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" %s/>\n",
                      name, a.x, a.y, b.x, b.y, style);
  }

  void pit() {
    if (!track_.pit()) return;
    const auto mark = [this](double s_m, const char* name) {
      const TrackPoint p = track_.at(s_m);
      across(p, "pit", "stroke=\"#c03080\" stroke-width=\"2\"");
      const double inside_m = -outward() > 0.0 ? p.width_left_m : p.width_right_m;
      const Pixel words = beside(p, -outward() * (inside_m + 38.0 / px_per_m_));
      text({words.x, words.y + 4.0}, name, "text-anchor=\"middle\" fill=\"#c03080\"");
    };
    mark(track_.pit()->entry_s_m, "pit entry");
    mark(track_.pit()->exit_s_m, "pit exit");
  }

  void start() {
    const TrackPoint p = track_.at(0.0);
    across(p, "start", "stroke=\"#d01010\" stroke-width=\"3\"");
    const double inside_m = -outward() > 0.0 ? p.width_left_m : p.width_right_m;
    const TrackPoint on = track_.at(60.0 / px_per_m_);
    const Pixel a = beside(p, -outward() * (inside_m + 14.0 / px_per_m_));
    const Pixel b = beside(on, -outward() * (inside_m + 14.0 / px_per_m_));
    const double dx = b.x - a.x, dy = b.y - a.y, far = std::max(std::hypot(dx, dy), 1e-9);
    const double ux = dx / far, uy = dy / far;
    out_ += formatted(
        "<path class=\"direction\" d=\"M%.1f,%.1f L%.1f,%.1f M%.1f,%.1f L%.1f,%.1f L%.1f,%.1f\" "
        "fill=\"none\" stroke=\"#d01010\" stroke-width=\"2\"/>\n",
        a.x, a.y, b.x, b.y, b.x - 9.0 * ux - 5.0 * uy, b.y - 9.0 * uy + 5.0 * ux, b.x, b.y,
        b.x - 9.0 * ux + 5.0 * uy, b.y - 9.0 * uy - 5.0 * ux);
  }

  void legend() {
    constexpr double kX_px = 480.0, kBar_px = 320.0, kY_px = kHeight_px - 44.0;
    constexpr int kSteps = 32;
    out_ += "<g class=\"legend\">\n";
    for (int i = 0; i < kSteps; ++i)
      out_ += formatted(
          "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"12\" fill=\"%s\"/>\n",
          kX_px + kBar_px * i / kSteps, kY_px, kBar_px / kSteps + 0.5,
          colour_of(bank_share(bank_low_ + (bank_high_ - bank_low_) * i / (kSteps - 1))).c_str());
    for (const double share : {0.0, 0.5, 1.0})
      text({kX_px + share * kBar_px, kY_px + 27.0},
           formatted("%.1f°", to_deg(bank_low_ + share * (bank_high_ - bank_low_))),
           "text-anchor=\"middle\"");
    text({kX_px + 0.5 * kBar_px, kY_px - 6.0}, "banking", "text-anchor=\"middle\"");
    out_ += "</g>\n";
  }

  void scale_bar() {
    double bar_m = 1.0;  // the largest of 1, 2, 5, 10, ... that fits
    for (const double step : {2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0, 2000.0})
      if (step * px_per_m_ < 220.0) bar_m = step;
    const double x = kMargin_px, y = kHeight_px - 38.0, end = x + bar_m * px_per_m_;
    out_ += formatted(
        "<path class=\"scale\" d=\"M%.1f,%.1f v8 M%.1f,%.1f H%.1f M%.1f,%.1f v8\" fill=\"none\" "
        "stroke=\"#202020\" stroke-width=\"2\"/>\n",
        x, y - 4.0, x, y, end, end, y - 4.0);
    text({x, y + 20.0}, formatted("%.0f m", bar_m));
  }

  void north() {
    const double x = kWidth_px - kMargin_px, y = kHeight_px - 34.0;
    out_ += formatted(
        "<path class=\"north\" d=\"M%.1f,%.1f l7,26 l-7,-6 l-7,6 z\" fill=\"#202020\"/>\n", x,
        y - 14.0);
    text({x, y - 20.0}, "N", "text-anchor=\"middle\" font-weight=\"bold\"");
  }

  void words() {
    text({kMargin_px, 34.0}, report::escaped(track_.name().substr(0, 80)),
         "font-size=\"22\" font-weight=\"bold\"");
    text({kMargin_px, 54.0},
         formatted("%.1f m, banked %.1f to %.1f degrees; from above, the road as wide as it is",
                   track_.length_m(), to_deg(bank_low_), to_deg(bank_high_)),
         "fill=\"#505050\"");
  }

  const TrackMap& track_;
  std::vector<TrackPoint> at_;
  double px_per_m_ = 1.0, bank_low_ = 1e300, bank_high_ = -1e300;
  Pixel middle_;  // in metres
  std::string out_;
};

}  // namespace

std::string picture_of(const TrackMap& track) { return Picture{track}.draw(); }

}  // namespace pitwall::track_file
