// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/plot_verb.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>
#include <vector>

#include "hil/cli/command_line.hpp"
#include "hil/cli/dbc/dbc_findings.hpp"
#include "hil/cli/dbc/signal_name.hpp"
#include "hil/cli/exit_code.hpp"
#include "hil/nodes/can_variant.hpp"
#include "hil/replay/formats/calendar.hpp"
#include "hil/replay/reading/can_file.hpp"
#include "hil/replay/reading/progress_line.hpp"
#include "hil/report/signal_plot.hpp"
#include "hil/report/signal_series.hpp"
#include "protocol/can/dbc_parser.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

constexpr double kMaxSpan_s = 1e10;  // longer than the calendar of any log

struct PlotOptions {
  std::string log, dbc_file, out = "plot.html", channel;
  std::vector<std::string> signals;
  double from_s = 0.0, until_s = kMaxSpan_s;
  bool progress = false;
};

Result<can::Database, Problem> database_of(const PlotOptions& options) {
  if (options.dbc_file.empty()) {
    const auto variant = can_variant::CanVariant::of(scenario::BusRevision::kV14);
    if (!variant) return Unexpected{variant.error()};
    return variant->database();
  }
  const auto text = transport::read_file(options.dbc_file, can::kMaxDbcBytes);
  if (!text) return Unexpected{text.error()};
  auto database = can::parse_dbc_leniently(*text, options.dbc_file);
  if (database) std::fprintf(stderr, "%s", errors_text(*database).c_str());
  return database;
}

Result<std::vector<report::ChosenSignal>, Problem> chosen_of(const PlotOptions& options,
                                                             const can::Database& database) {
  std::vector<report::ChosenSignal> chosen;
  for (const std::string& words : options.signals) {
    const auto found = find_signal(database, words);
    if (!found) return Unexpected{found.error()};
    chosen.push_back({found->message, found->signal});
  }
  return chosen;
}

Result<report::LogPart, Problem> part_of(const PlotOptions& options, const replay::CanLog& log) {
  if (!(options.until_s >= options.from_s + report::kLeastDrawn_s))
    return Unexpected{Problem{formatted("--from %g --until %g", options.from_s, options.until_s),
                              "expected --until at least 1 ms after --from"}};
  const double length_s = report::span_of(log).length_s;
  if (options.from_s > length_s)
    return Unexpected{Problem{formatted("--from %g", options.from_s),
                              formatted("%s ends at %.3f s", options.log.c_str(), length_s)}};
  if (!options.channel.empty() &&
      std::ranges::find(log.channels, options.channel) == log.channels.end()) {
    std::string all;
    for (const std::string& channel : log.channels) all += (all.empty() ? "" : ", ") + channel;
    return Unexpected{Problem{"--channel " + options.channel,
                              options.log + " has no such channel; it has " + all}};
  }
  return report::LogPart{
      options.from_s,
      std::max(std::min(options.until_s, length_s), options.from_s + report::kLeastDrawn_s),
      options.channel};
}

// What a series lacks, one line each; empty where it is whole.
std::vector<std::string> remarks_on(const report::SignalSeries& series) {
  std::vector<std::string> out;
  const auto add = [&](std::uint64_t count, const char* what) {
    if (count > 0)
      out.push_back(series.name() +
                    formatted(": %llu %s", static_cast<unsigned long long>(count), what));
  };
  add(series.other_frames, "frames have its identifier, but another length or kind: not decoded");
  add(series.not_drawn, "values are no finite number up to 1e100: not drawn");
  if (series.values > 0) return out;
  const can::Message& message = *series.chosen.message;
  const bool is_left_out = series.absent > 0 && series.other_frames + series.not_drawn == 0;
  out.push_back(
      series.name() +
      (is_left_out ? formatted(": never comes: its multiplexer leaves it out of all %llu frames",
                               static_cast<unsigned long long>(series.absent))
                   : formatted(": never comes in this part of the log: no frame 0x%X%s of %u bytes",
                               message.id, message.extended ? " (29 bits)" : "", message.length)));
  return out;
}

std::string start_text(UtcTime begin) {
  if (replay::parts_of(begin).day.year <= 1970) return "0 s is the first frame; no date in the log";
  return "0 s is " + replay::calendar_text(begin);
}

report::SignalPlot plot_of(const PlotOptions& options, const replay::CanLog& log,
                           const can::Database& database,
                           std::span<const report::SignalSeries> series,
                           const report::LogPart& part) {
  report::SignalPlot plot{.title = options.log,
                          .caption = {start_text(report::span_of(log).begin)},
                          .series = series,
                          .from_s = part.from_s,
                          .to_s = part.to_s};
  std::string& facts = plot.caption.front();
  facts += "; " + log.format + "; database " + database.name;
  if (!part.channel.empty()) facts += "; channel " + part.channel;
  facts += formatted("; a pause over %g mean periods is not bridged", report::kGapPeriods);
  for (const report::SignalSeries& one : series)
    for (std::string& remark : remarks_on(one)) plot.caption.push_back(std::move(remark));
  return plot;
}

int write_plot(const PlotOptions& options, const report::SignalPlot& plot) {
  std::uint64_t values = 0;
  bool is_whole = true;
  for (const report::SignalSeries& series : plot.series) {
    values += series.values;
    is_whole = is_whole && series.values > 0;
  }
  for (std::size_t i = 1; i < plot.caption.size(); ++i)
    std::fprintf(stderr, "%s\n", plot.caption[i].c_str());
  if (values == 0) {
    std::fprintf(stderr, "%s: not written: there is nothing to draw\n", options.out.c_str());
    return kExitFailed;
  }
  const bool is_page = options.out.ends_with(".html");
  const auto written = transport::write_file(
      options.out, is_page ? report::signal_page(plot) : report::signal_svg(plot));
  if (!written) return refuse(written.error());
  std::printf("%s: %llu values of %zu signals\n", options.out.c_str(),
              static_cast<unsigned long long>(values), options.signals.size());
  return is_whole ? kExitPass : kExitFailed;
}

int plot(const PlotOptions& options) {
  if (!options.out.ends_with(".svg") && !options.out.ends_with(".html"))
    return refuse({"--out " + options.out, "expected a name that ends in .svg or .html"});
  const auto database = database_of(options);
  if (!database) return refuse(database.error());
  const auto chosen = chosen_of(options, *database);
  if (!chosen) return refuse(chosen.error());
  const auto log = replay::read_can_file(options.log, options.progress);
  if (!log) return refuse(log.error());
  std::fprintf(stderr, "%s", replay::to_text(*log, options.log).c_str());
  const auto part = part_of(options, *log);
  if (!part) return refuse(part.error());
  const auto series = report::signal_series(*log, *chosen, *part);
  return write_plot(options, plot_of(options, *log, *database, series, *part));
}

}  // namespace

int plot_verb(std::span<const std::string> args) {
  PlotOptions options;
  CommandLine app{
      "pitwall-hil plot: signals of a CAN log or a recording over time, one panel per unit, as an "
      "SVG file or an "
      "HTML page that needs no network. Exit 0 drawn, 1 a signal never comes, 2 unusable"};
  app.option("LOG", options.log,
             "log or recording of any format that info reads, known by its content")
      .required();
  app.option("SIGNAL", options.signals, "MESSAGE.SIGNAL of the database, one or more").required();
  app.option("--dbc", options.dbc_file,
             "CAN database, read as far as it can be; default: the car's own");
  app.option("--out", options.out, "new file, .svg or .html").shows_default();
  app.option("--channel", options.channel, "only this channel; default: each has its own line");
  app.option("--from", options.from_s, "seconds from the start of the log; default: its start")
      .range(0.0, kMaxSpan_s);
  app.option("--until", options.until_s, "likewise; default: its end").range(0.0, kMaxSpan_s);
  app.flag("--progress", options.progress, replay::kProgressHelp);
  if (const auto code = app.ended_by(args)) return *code;
  return plot(options);
}

}  // namespace pitwall::cli
