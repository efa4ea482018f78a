// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

#include "tests/benchmarks/codec/peer.hpp"

namespace pitwall::codec {
namespace {

namespace fs = std::filesystem;

const char* kind_of(FieldIndex i) {
  const FieldKind kind = telemetry::kFields[i].kind();
  return kind == FieldKind::kReal ? "real" : "whole";
}

void write_trace(const fs::path& file, const std::vector<Values>& trace) {
  constexpr std::size_t kEvery = 10;  // JavaScript is slow; sizes vary little
  std::ofstream out(file);
  out.precision(9);
  const char* comma = "";
  out << "{\"fields\":[";
  for (const FieldIndex i : telemetry::kVehicleState) {
    const telemetry::FieldRow& row = telemetry::kFields[i];
    out << comma << "{\"name\":\"" << row.name << "\",\"kind\":\"" << kind_of(i)
        << "\",\"min\":" << row.min << ",\"max\":" << row.max
        << ",\"resolution\":" << row.resolution << '}';
    comma = ",";
  }
  out << "],\"frames\":[";
  for (std::size_t k = 0; k < trace.size(); k += kEvery) {
    out << (k == 0 ? "[" : ",[");
    comma = "";
    for (const FieldIndex i : telemetry::kVehicleState) {
      out << comma << trace[k][i];
      comma = ",";
    }
    out << ']';
  }
  out << "]}\n";
}

std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), &pclose);
  if (!pipe) return {};
  std::string text;
  std::array<char, 512> part{};
  while (std::fgets(part.data(), part.size(), pipe.get()) != nullptr) text += part.data();
  return text;
}

double number_after(const std::string& text, std::size_t from, const std::string& key) {
  const std::size_t at = text.find("\"" + key + "\":", from);
  return at == std::string::npos ? 0.0 : std::strtod(text.c_str() + at + key.size() + 3, nullptr);
}

}  // namespace

std::vector<Measured> mavlink(const std::vector<Values>& trace) {
  const fs::path oracles = fs::path{PITWALL_SOURCE_DIR} / "tests/support/oracles";
  if (!fs::exists(oracles / "node_modules/node-mavlink")) return {};
  const fs::path file =
      fs::temp_directory_path() / ("pitwall_codec_" + std::to_string(trace.size()) + ".json");
  write_trace(file, trace);
  const std::string text =
      output_of("'" + (oracles / "node_modules/.bin/node").string() + "' '" +
                (oracles / "mavlink_sizes.mjs").string() + "' '" + file.string() + "'");
  fs::remove(file);
  std::vector<Measured> all;
  for (const std::string form :
       {"decimal", "decimal, one message", "squeezed", "squeezed, one message", "float"}) {
    const std::size_t from = text.find("\"" + form + "\":{");
    if (from == std::string::npos) return {};
    all.push_back({.name = "MAVLink 2 signed, " + form,
                   .bytes_by = "node-mavlink (dialect by hand)",
                   .payload = number_after(text, from, "payload"),
                   .datagram = number_after(text, from, "datagram"),
                   .authenticated = true,
                   .encode_ns = {},
                   .decode_ns = {}});
  }
  return all;
}

}  // namespace pitwall::codec
