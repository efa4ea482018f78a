// SPDX-License-Identifier: Apache-2.0
#include "vehicle/raceline/bank_picture.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>
#include <vector>

#include "protocol/vocabulary/text.hpp"

namespace pitwall::raceline {
namespace {

constexpr double kWidth_px = 1600.0, kMargin_px = 60.0, kMap_px = 800.0, kPanel_px = 260.0;
constexpr double kHead_px = 40.0, kGap_px = 50.0, kLetter_px = 8.0, kTime_px = 80.0;
constexpr double kStep_m = 3.0;  // between drawn points
constexpr std::array kColours{"#c0392b", "#e67e22", "#b7950b", "#1e8449", "#117a65",
                              "#2471a3", "#6c3483", "#d81b60", "#000000", "#5d4037"};

// What is drawn of a line: where it is on the map, beside the track, how it bends, how fast it is.
struct Drawn {
  double x_m, y_m, station_m, offset_m, curvature_per_m, speed_mps;
};

struct Panel {
  double top_px, height_px;
  double low, high;  // of the value
  double y_px(double value) const {
    return top_px + height_px * (1.0 - (std::clamp(value, low, high) - low) / (high - low));
  }
};

// Names come from files: what could be markup is left out.
constexpr std::string_view kPlain{"/-_"};
std::string plain(const std::string& name) {
  std::string out;
  for (const char c : name)
    out +=
        std::isalnum(static_cast<unsigned char>(c)) != 0 || kPlain.find(c) != kPlain.npos ? c : ' ';
  return out;
}

class Picture {
 public:
  Picture(const RacelineBank& bank, const world::TrackMap& track)
      : bank_(bank), track_(track), lanes_(track) {
    for (const Raceline& line : bank.lines) drawn_.push_back(drawn(line));
    measure();
  }

  std::string draw() {
    const Panel& last = has_speeds_ ? speed_ : curvature_;
    const double height_px = last.top_px + last.height_px + kMargin_px;
    out_ = formatted(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"%.0f\" height=\"%.0f\" "
        "font-family=\"DejaVu Sans, sans-serif\" font-size=\"13\">\n"
        "<rect width=\"100%%\" height=\"100%%\" fill=\"#ffffff\"/>\n",
        kWidth_px, height_px);
    text(kMargin_px, 26.0, "Racelines of " + plain(bank_.track), "font-size=\"18\"");
    map();
    unrolled();
    bends();
    if (has_speeds_) speeds();
    legend();
    return out_ + "</svg>\n";
  }

 private:
  std::vector<Drawn> drawn(const Raceline& line) const {
    std::vector<Drawn> row;
    const auto every =
        std::max(std::size_t{1}, static_cast<std::size_t>(kStep_m / line.spacing_m()));
    double station_m = 0.0;
    for (std::size_t i = 0; i < line.points.size(); i += every) {
      const RacelinePoint& p = line.points[i];
      const world::Curvilinear place = track_.project(p.x_m, p.y_m, station_m);
      station_m = place.s_m;
      row.push_back({p.x_m, p.y_m, place.s_m, place.n_m, p.curvature_per_m,
                     line.lap.empty() ? kUnset : line.lap[i].speed_mps});
    }
    return row;
  }

  // What the panels and the map span.
  void measure() {
    double low_x = 1e300, high_x = -1e300, low_y = 1e300, high_y = -1e300;
    double low_n = 0.0, high_n = 0.0, low_bend = 0.0, high_bend = 0.0, high_speed = 0.0;
    const auto place = [&](double x_m, double y_m) {
      low_x = std::min(low_x, x_m), high_x = std::max(high_x, x_m);
      low_y = std::min(low_y, y_m), high_y = std::max(high_y, y_m);
    };
    for (std::size_t i = 0; i < track_.size(); ++i) {
      const world::TrackPoint& p = track_.point(i);
      for (const double n_m : {p.width_left_m, -p.width_right_m}) {
        const world::TrackPoint wall = track_.offset(p.s_m, n_m);
        place(wall.x_m, wall.y_m);
        low_n = std::min(low_n, n_m), high_n = std::max(high_n, n_m);
      }
    }
    if (const auto& pit = track_.pit()) {
      low_n = std::min(low_n, pit->offset_m - 0.5 * pit->width_m);
      high_n = std::max(high_n, pit->offset_m + 0.5 * pit->width_m);
    }
    for (const auto& row : drawn_)
      for (const Drawn& d : row) {
        place(d.x_m, d.y_m);
        low_n = std::min(low_n, d.offset_m), high_n = std::max(high_n, d.offset_m);
        low_bend = std::min(low_bend, d.curvature_per_m);
        high_bend = std::max(high_bend, d.curvature_per_m);
        if (std::isnan(d.speed_mps)) continue;
        high_speed = std::max(high_speed, d.speed_mps);
        has_speeds_ = true;
      }
    const double across_px = kWidth_px - 2.0 * kMargin_px;
    px_per_m_ = std::min(across_px / (high_x - low_x), kMap_px / (high_y - low_y));
    left_m_ = 0.5 * (low_x + high_x) - 0.5 * kWidth_px / px_per_m_;
    top_m_ = high_y + kHead_px / px_per_m_;
    const double map_px = (high_y - low_y) * px_per_m_ + kHead_px;
    road_ = {map_px + kGap_px, kPanel_px, low_n - 1.0, high_n + 1.0};
    curvature_ = {road_.top_px + kPanel_px + kGap_px, kPanel_px, 1.1 * low_bend - 1e-4,
                  1.1 * high_bend + 1e-4};
    speed_ = {curvature_.top_px + kPanel_px + kGap_px, kPanel_px, 0.0, 1.05 * high_speed};
  }

  double station_px(double s_m) const {
    return kMargin_px + s_m / track_.length_m() * (kWidth_px - 2.0 * kMargin_px);
  }
  std::string map_point(double x_m, double y_m) const {
    return formatted("%.1f,%.1f ", (x_m - left_m_) * px_per_m_, (top_m_ - y_m) * px_per_m_);
  }

  void text(double x_px, double y_px, const std::string& words, const char* style = "") {
    out_ += formatted("<text x=\"%.1f\" y=\"%.1f\" %s>", x_px, y_px, style) + words + "</text>\n";
  }
  void shape(const char* element, const std::string& points, const std::string& style) {
    out_ += formatted("<%s points=\"", element) + points + "\" " + style + "/>\n";
  }
  static std::string stroke(std::size_t line) {
    return formatted("fill=\"none\" stroke=\"%s\" stroke-width=\"1.3\"",
                     kColours[line % kColours.size()]);
  }

  // The walls, or the border between the lanes, as points of the map or of the unrolled road.
  template <class Fn>
  std::string edge(Fn&& offset_of, bool is_map) const {
    std::string points;
    const auto count = static_cast<std::size_t>(std::ceil(track_.length_m() / kStep_m));
    for (std::size_t i = 0; i <= count; ++i) {
      const double s_m = track_.length_m() * static_cast<double>(i) / static_cast<double>(count);
      const double n_m = offset_of(s_m);
      const world::TrackPoint p = track_.offset(s_m, n_m);
      points += is_map ? map_point(p.x_m, p.y_m)
                       : formatted("%.1f,%.1f ", station_px(s_m), road_.y_px(n_m));
    }
    return points;
  }

  void road(bool is_map) {
    const auto left = [&](double s_m) { return track_.at(s_m).width_left_m; };
    const auto right = [&](double s_m) { return -track_.at(s_m).width_right_m; };
    const Region left_lane = lanes_.turns_left() ? Region::kInnerLane : Region::kOuterLane;
    const auto border = [&](double s_m) { return lanes_.band(left_lane, s_m).right_m; };
    for (const std::string& wall : {edge(left, is_map), edge(right, is_map)})
      shape("polyline", wall,
            "class=\"wall\" fill=\"none\" stroke=\"#202020\" stroke-width=\"1.5\"");
    shape("polyline", edge(border, is_map),
          "class=\"lanes\" fill=\"none\" stroke=\"#909090\" stroke-dasharray=\"8 6\"");
  }

  // The sides of the pit lane; on the unrolled road it may lie across the start.
  void pit(bool is_map) {
    if (!track_.pit()) return;
    const world::PitLane& pit = *track_.pit();
    for (const double side : {-0.5, 0.5}) {
      const double n_m = pit.offset_m + side * pit.width_m;
      std::string points;
      const auto flush = [&] {
        shape("polyline", points, "class=\"pit\" fill=\"none\" stroke=\"#a0a0a0\"");
        points.clear();
      };
      const double length_m = track_.station_ahead(pit.entry_s_m, pit.exit_s_m);
      for (double along_m = 0.0; along_m < length_m; along_m += kStep_m) {
        const world::TrackPoint p = track_.offset(pit.entry_s_m + along_m, n_m);
        const double s_m = track_.wrap_station(pit.entry_s_m + along_m);
        if (!is_map && s_m < kStep_m && !points.empty()) flush();
        points += is_map ? map_point(p.x_m, p.y_m)
                         : formatted("%.1f,%.1f ", station_px(s_m), road_.y_px(n_m));
      }
      flush();
    }
  }

  void map() {
    road(true);
    pit(true);
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      std::string points;
      for (const Drawn& d : drawn_[i]) points += map_point(d.x_m, d.y_m);
      shape("polygon", points, "class=\"line\" " + stroke(i));
    }
  }

  void frame(const Panel& panel, const std::string& title, int decimals, double scale) {
    out_ += formatted(
        "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"none\" "
        "stroke=\"#b0b0b0\"/>\n",
        kMargin_px, panel.top_px, kWidth_px - 2.0 * kMargin_px, panel.height_px);
    text(kMargin_px, panel.top_px - 8.0, title);
    for (const double value : {panel.low, panel.high})
      text(kMargin_px - 6.0, panel.y_px(value) + 4.0, formatted("%.*f", decimals, value * scale),
           "text-anchor=\"end\"");
    for (double s_m = 0.0; s_m < track_.length_m(); s_m += 500.0)
      text(station_px(s_m), panel.top_px + panel.height_px + 16.0, formatted("%.0f m", s_m),
           "text-anchor=\"middle\"");
  }

  template <class Fn>
  void rows(Fn&& y_px_of) {
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      std::vector<Drawn> row = drawn_[i];
      std::ranges::sort(row, {}, &Drawn::station_m);
      std::string points;
      for (const Drawn& d : row)
        points += formatted("%.1f,%.1f ", station_px(d.station_m), y_px_of(d));
      shape("polyline", points, stroke(i));
    }
  }

  void unrolled() {
    frame(road_, "offset from the reference line, m, left is up", 0, 1.0);
    road(false);
    pit(false);
    rows([&](const Drawn& d) { return road_.y_px(d.offset_m); });
  }

  void bends() {
    frame(curvature_, "curvature, 1/km, left is positive", 1, 1000.0);
    rows([&](const Drawn& d) { return curvature_.y_px(d.curvature_per_m); });
  }

  void speeds() {
    frame(speed_, "speed, m/s; lap times, s:", 0, 1.0);
    double x_px = kMargin_px + 200.0;
    for (std::size_t i = 0; i < bank_.lines.size(); ++i, x_px += kTime_px)
      text(x_px, speed_.top_px - 8.0, formatted("%.3f", bank_.lines[i].lap_s),
           formatted("fill=\"%s\"", kColours[i % kColours.size()]).c_str());
    rows([&](const Drawn& d) { return speed_.y_px(std::isnan(d.speed_mps) ? 0.0 : d.speed_mps); });
  }

  void legend() {
    double x_px = kMargin_px + 190.0;
    for (std::size_t i = 0; i < bank_.lines.size(); ++i) {
      const std::string name = plain(bank_.lines[i].name);
      text(x_px, 26.0, name, formatted("fill=\"%s\"", kColours[i % kColours.size()]).c_str());
      x_px += kLetter_px * static_cast<double>(name.size()) + 24.0;
    }
  }

  const RacelineBank& bank_;
  const world::TrackMap& track_;
  Lanes lanes_;
  std::vector<std::vector<Drawn>> drawn_;
  Panel road_{}, curvature_{}, speed_{};
  bool has_speeds_ = false;
  double px_per_m_ = 1.0, left_m_ = 0.0, top_m_ = 0.0;
  std::string out_;
};

}  // namespace

std::string picture_of(const RacelineBank& bank, const world::TrackMap& track) {
  return Picture{bank, track}.draw();
}

}  // namespace pitwall::raceline
