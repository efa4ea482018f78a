// SPDX-License-Identifier: Apache-2.0
#include "hil/cli/recordings/difference_text.hpp"

#include "protocol/json/json_text.hpp"
#include "protocol/vocabulary/text.hpp"

namespace pitwall::cli {
namespace {

double seconds_in(const bench::Divergence& divergence, Instant begun) {
  return (divergence.at - begun).seconds();
}

std::string text_of(const bench::SignalDifference& d, Instant begun) {
  return formatted("%s: %llu values differ\n", d.signal.c_str(),
                   static_cast<unsigned long long>(d.values)) +
         formatted("  first    %9.2f s, tick %llu: recorded %.9g, now %.9g; ",
                   seconds_in(d.first, begun), static_cast<unsigned long long>(d.first.tick),
                   d.first.recorded, d.first.again) +
         d.context +
         formatted("\n  largest  %9.2f s: recorded %.9g, now %.9g, by %.9g\n",
                   seconds_in(d.largest, begun), d.largest.recorded, d.largest.again,
                   d.largest.size());
}

std::string json_of(const bench::Divergence& d, Instant begun) {
  return json::Object{}
      .number("tick", d.tick)
      .number("at_s", seconds_in(d, begun))
      .number("recorded", d.recorded)
      .number("now", d.again)
      .str();
}

}  // namespace

std::string differences_text(std::span<const bench::SignalDifference> differences, Instant begun) {
  std::string text;
  for (const bench::SignalDifference& difference : differences) text += text_of(difference, begun);
  return text;
}

std::string differences_json(std::span<const bench::SignalDifference> differences, Instant begun) {
  json::Array out;
  for (const bench::SignalDifference& d : differences)
    out.json(json::Object{}
                 .text("signal", d.signal)
                 .number("values", d.values)
                 .json("first", json_of(d.first, begun))
                 .json("largest", json_of(d.largest, begun))
                 .text("context", d.context)
                 .str());
  return out.str();
}

}  // namespace pitwall::cli
