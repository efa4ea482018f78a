// SPDX-License-Identifier: Apache-2.0
#include "hil/link/trace.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "hil/link/fade_process.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::link {
namespace {

constexpr double kLongest_s = 1e6;
constexpr double kLongest_m = 1e6;

enum class Columns { kNone, kOutages, kStations };

Unexpected<Problem> at_line(const std::string& name, std::size_t line, const std::string& what) {
  return Unexpected{Problem{name + ":" + std::to_string(line), what}};
}

// The numbers of a row; none: something in it is no number.
std::optional<std::vector<double>> numbers_of(std::string_view row) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = std::min(row.find(','), row.size());
    std::string_view cell = row.substr(0, comma);
    while (cell.starts_with(' ')) cell.remove_prefix(1);
    while (cell.ends_with(' ')) cell.remove_suffix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value))
      return std::nullopt;
    numbers.push_back(value);
    if (comma == row.size()) return numbers;
    row.remove_prefix(comma + 1);
  }
}

// Each returns what is wrong with the row; empty: it has been added.
std::string add_outage(LinkTrace& trace, const std::vector<double>& row) {
  if (row.size() != 2 && row.size() != 3) return "expected from_s,to_s or from_s,to_s,loss";
  const double loss = row.size() == 3 ? row[2] : 1.0;
  if (row[0] < 0.0 || row[1] > kLongest_s) return "expected times of 0 to 1000000 s";
  if (row[0] >= row[1]) return "the outage ends before it begins";
  if (loss < 0.0 || loss > 1.0) return "expected a loss of 0 to 1";
  const Outage outage{Instant{} + from_seconds(row[0]), Instant{} + from_seconds(row[1]), loss};
  if (!trace.outages.empty() && outage.from < trace.outages.back().to)
    return "the outage begins before the one above it has ended";
  trace.outages.push_back(outage);
  return {};
}

std::string add_station(LinkTrace& trace, const std::vector<double>& row) {
  if (row.size() != 2) return "expected station_m,loss";
  if (row[0] < 0.0 || row[0] > kLongest_m) return "expected stations of 0 to 1000000 m";
  if (row[1] < 0.0 || row[1] > 1.0) return "expected a loss of 0 to 1";
  if (!trace.by_station.empty() && row[0] <= trace.by_station.back().station_m)
    return "expected rising stations";
  trace.by_station.push_back({row[0], row[1]});
  return {};
}

Columns columns_of(std::string_view header) {
  if (header == "from_s,to_s" || header == "from_s,to_s,loss") return Columns::kOutages;
  return header == "station_m,loss" ? Columns::kStations : Columns::kNone;
}

double wrapped(double station_m, double lap_length_m) {
  return lap_length_m > 0.0 ? station_m - std::floor(station_m / lap_length_m) * lap_length_m
                            : station_m;
}

}  // namespace

Result<LinkTrace, Problem> read_trace(std::string_view text, const std::string& name) {
  LinkTrace trace;
  Columns columns = Columns::kNone;
  std::size_t number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    ++number;
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (line.empty() || line.starts_with('#')) continue;
    if (columns == Columns::kNone) {
      columns = columns_of(line);
      if (columns == Columns::kNone)
        return at_line(name, number,
                       "expected the columns from_s,to_s or from_s,to_s,loss or station_m,loss");
      continue;
    }
    const auto row = numbers_of(line);
    if (!row) return at_line(name, number, "\"" + std::string(line) + "\" is no row of numbers");
    const std::string wrong =
        columns == Columns::kOutages ? add_outage(trace, *row) : add_station(trace, *row);
    if (!wrong.empty()) return at_line(name, number, wrong);
  }
  if (columns == Columns::kNone) return at_line(name, number, "the file names no columns");
  return trace;
}

std::string write_trace(const LinkTrace& trace) {
  std::string text = "from_s,to_s,loss\n";
  for (const Outage& o : trace.outages) {
    text += formatted("%.9f,%.9f,%.6g\n", Duration{o.from.ns}.seconds(),
                      Duration{o.to.ns}.seconds(), o.loss);
  }
  return text;
}

LinkTrace trace_of(const Fades& fades, std::uint64_t seed, Duration length) {
  LinkTrace trace;
  FadeProcess process(fades, seed);
  const Instant end = Instant{} + length;
  for (Instant at{}; at < end; at = process.until()) {
    if (process.bad(at))
      trace.outages.push_back({at, std::min(process.until(), end), fades.loss_bad});
  }
  return trace;
}

double loss_over_time(const LinkTrace& trace, Instant at) {
  if (trace.repeat > Duration{}) at = {at.ns % trace.repeat.ns};
  const auto after = std::ranges::upper_bound(trace.outages, at, {}, &Outage::from);
  if (after == trace.outages.begin()) return 0.0;
  const Outage& outage = *std::prev(after);
  return at < outage.to ? outage.loss : 0.0;
}

double loss_at_station(const LinkTrace& trace, double station_m) {
  const auto& stations = trace.by_station;
  if (stations.empty()) return 0.0;
  const double at = wrapped(station_m, trace.lap_length_m);
  const auto distance = [&](const StationLoss& s) {
    const double apart = std::abs(s.station_m - at);
    return trace.lap_length_m > 0.0 ? std::min(apart, trace.lap_length_m - apart) : apart;
  };
  // The nearest is a neighbour in order, or the first or last across the line.
  const auto after = std::ranges::lower_bound(stations, at, {}, &StationLoss::station_m);
  const StationLoss& above = after == stations.end() ? stations.front() : *after;
  const StationLoss& below = after == stations.begin() ? stations.back() : *std::prev(after);
  return distance(above) < distance(below) ? above.loss : below.loss;
}

}  // namespace pitwall::link
