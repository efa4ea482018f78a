// `bench codec [--json FILE]`: the vehicle's state, 84 real numbers, 10 integers and 6 of yes or
// no, over a lap in the encodings that teams send it in; sizes and times. All bytes are those of
// the real libraries but JSON's.
//   out    a table; exit code 1 when a gate is missed, 2 when a contestant of a gate is not there
//   units  bytes, means over the trace; "on the wire" is with IPv4 and UDP; ns, best of batches
//   law    every frame is read again and compared before a size counts
// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <limits>

#include "protocol/telemetry/packet/header.hpp"
#include "tests/benchmarks/codec/contestant.hpp"
#include "tests/benchmarks/codec/lap.hpp"

namespace pitwall::codec {
namespace {

constexpr Duration kTrace = seconds(60), kStep = milliseconds(10);
constexpr std::size_t kBatch = 100, kBatches = 400;
constexpr std::size_t kLargest = 8'192;
constexpr int kHeld = 0, kMissed = 1, kNotThere = 2;

bool kept(const Contestant& contestant, const Values& sent, const Values& read) {
  for (const FieldIndex i : telemetry::kVehicleState) {
    const double resolution = telemetry::kFields[i].resolution;
    double bound = 0.0;
    if (contestant.keeps == Keeps::kFloat) bound = std::abs(sent[i]) * 1e-6;
    if (contestant.keeps == Keeps::kSteps) bound = resolution * 0.5 * (1 + 1e-9);
    if (!(std::abs(read[i] - sent[i]) <= bound)) {
      std::fprintf(stderr, "%s: %s was %.9g and is read as %.9g\n", contestant.name.c_str(),
                   telemetry::kFields[i].name.data(), sent[i], read[i]);
      return false;
    }
  }
  return true;
}

// The best of many short batches, with the values in the cache: what else the machine does meets
// only some of them.
template <class Work>
double nanoseconds_each(Work&& work) {
  using Clock = std::chrono::steady_clock;
  double best = std::numeric_limits<double>::infinity();
  for (std::size_t batch = 0; batch < kBatches; ++batch) {
    const auto begun = Clock::now();
    for (std::size_t i = 0; i < kBatch; ++i) work(i);
    const std::chrono::duration<double, std::nano> took = Clock::now() - begun;
    best = std::min(best, took.count() / static_cast<double>(kBatch));
  }
  return best;
}

std::optional<Measured> measure(const Contestant& contestant, const std::vector<Values>& trace) {
  std::vector<std::vector<std::uint8_t>> written;
  std::vector<std::uint8_t> buffer(kLargest);
  double bytes = 0.0;
  Values read;
  for (const Values& values : trace) {
    const std::size_t size = contestant.encode(values, buffer);
    written.emplace_back(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(size));
    bytes += static_cast<double>(size);
    if (!contestant.decode(written.back(), read) || !kept(contestant, values, read)) return {};
  }
  const double mean = bytes / static_cast<double>(trace.size());
  Measured measured{.name = contestant.name,
                    .bytes_by = contestant.bytes_by,
                    .payload = mean,
                    .datagram = mean,
                    .authenticated = false,
                    .encode_ns = {},
                    .decode_ns = {}};
  measured.encode_ns =
      nanoseconds_each([&](std::size_t i) { contestant.encode(trace[i], buffer); });
  measured.decode_ns =
      nanoseconds_each([&](std::size_t i) { contestant.decode(written[i], read); });
  return measured;
}

double wire_of(const Measured& m) {
  return m.datagram + static_cast<double>(telemetry::kIpUdpOverhead);
}

class Table {
 public:
  explicit Table(const std::vector<Values>& trace) : trace_(&trace) {}

  void add(const std::optional<Measured>& row, const char* what) {
    if (row) {
      rows_.push_back(*row);
    } else {
      std::printf("not measured: %s\n", what);
    }
  }
  void add(const Contestant& contestant, double header = 0.0) {
    auto row = measure(contestant, *trace_);
    if (row) row->datagram += header;
    add(row, contestant.name.c_str());
  }
  const Measured* find(const std::string& name) const {
    for (const Measured& row : rows_)
      if (row.name == name) return &row;
    return nullptr;
  }
  void print() const {
    std::printf("%-33s %8s %9s %8s %6s %5s %8s %8s  %s\n", "", "payload", "datagram", "on wire",
                "ours/", "auth", "encode", "decode", "bytes by");
    const double ours = wire_of(rows_.front());
    for (const Measured& row : rows_) {
      std::printf("%-33s %8.1f %9.1f %8.1f %6.3f %5s %8s %8s  %s\n", row.name.c_str(), row.payload,
                  row.datagram, wire_of(row), ours / wire_of(row), row.authenticated ? "yes" : "no",
                  time_text(row.encode_ns).c_str(), time_text(row.decode_ns).c_str(),
                  row.bytes_by.c_str());
    }
  }
  std::string json() const {
    std::string text;
    for (const Measured& row : rows_) {
      std::array<char, 400> line{};
      std::snprintf(line.data(), line.size(),
                    "%s{\"name\":\"%s\",\"payload\":%.2f,\"datagram\":%.2f,\"wire\":%.2f,"
                    "\"authenticated\":%s,\"encode_ns\":%s,\"decode_ns\":%s}",
                    text.empty() ? "" : ",", row.name.c_str(), row.payload, row.datagram,
                    wire_of(row), row.authenticated ? "true" : "false",
                    row.encode_ns ? time_text(row.encode_ns).c_str() : "null",
                    row.decode_ns ? time_text(row.decode_ns).c_str() : "null");
      text += line.data();
    }
    return "[" + text + "]";
  }

 private:
  static std::string time_text(const std::optional<double>& ns) {
    return ns ? std::to_string(static_cast<long>(std::lround(*ns))) : "-";
  }

  const std::vector<Values>* trace_;
  std::vector<Measured> rows_;
};

class Gates {
 public:
  void at_most(const std::string& what, double value, double limit) {
    const bool held = value <= limit;
    std::printf("  %-7s %s: %.3f, at most %.3f\n", held ? "held" : "MISSED", what.c_str(), value,
                limit);
    if (!held) outcome_ = std::max(outcome_, kMissed);
    json_ += std::string(json_.empty() ? "" : ",") + "{\"gate\":\"" + what +
             "\",\"value\":" + std::to_string(value) + ",\"limit\":" + std::to_string(limit) +
             ",\"held\":" + (held ? "true" : "false") + "}";
  }
  void ratio(const Table& table, const Measured& ours, const std::string& peer, double limit) {
    if (const Measured* row = table.find(peer)) {
      return at_most("on the wire, of " + peer, wire_of(ours) / wire_of(*row), limit);
    }
    std::printf("  NOT JUDGED: %s is not there\n", peer.c_str());
    outcome_ = kNotThere;
  }
  int outcome() const { return outcome_; }
  std::string json() const { return "[" + json_ + "]"; }

 private:
  int outcome_ = kHeld;
  std::string json_;
};

Table fill_table(const std::vector<Values>& trace) {
  Table table(trace);
  auto codec = measure(ours(), trace);
  auto sealed = measure(ours_sealed(), trace);
  for (auto* row : {&codec, &sealed}) {
    if (!*row || !sealed) continue;
    (*row)->payload = static_cast<double>(telemetry::bytes_of(telemetry::kVehicleStateSet));
    (*row)->datagram = sealed->datagram;
    (*row)->authenticated = true;
  }
  table.add(codec, "ours");
  table.add(sealed, "ours, sealed");
  const auto signed_forms = mavlink(trace);
  for (const Measured& form : signed_forms) table.add(form, "");
  if (signed_forms.empty()) table.add(std::nullopt, "MAVLink 2: npm packages, see ./pitwall setup");
#ifdef CODEC_PROTOBUF
  for (const Contestant& c : protobuf()) table.add(c);
#else
  table.add(std::nullopt, "protobuf: libprotobuf-dev, protobuf-compiler");
#endif
#ifdef CODEC_LCM
  table.add(lcm(), static_cast<double>(kLcmHeader));
#else
  table.add(std::nullopt, "LCM: liblcm-dev, liblcm-bin");
#endif
#ifdef CODEC_FASTCDR
  for (const Contestant& c : cdr()) table.add(c);
#else
  table.add(std::nullopt, "CDR: libfastcdr-dev");
#endif
#ifdef CODEC_CYCLONE
  table.add(cyclone(trace), "Cyclone DDS: no reader was matched");
#else
  table.add(std::nullopt, "Cyclone DDS: cyclonedds-dev, cyclonedds-tools");
#endif
#ifdef CODEC_FLATBUFFERS
  table.add(flatbuffers());
#else
  table.add(std::nullopt, "FlatBuffers: libflatbuffers-dev, flatbuffers-compiler");
#endif
#ifdef CODEC_CAPNP
  table.add(cap_n_proto());
#else
  table.add(std::nullopt, "Cap'n Proto: libcapnp-dev, capnproto");
#endif
  table.add(json());
  return table;
}

int run(const char* json_file) {
  const std::vector<Values> trace = lap_of(kTrace, kStep);
  std::printf("84 reals, 10 integers, 6 flags over %.0f s of a lap, %zu frames\n", kTrace.seconds(),
              trace.size());
  const Table table = fill_table(trace);
  const Measured* ours = table.find("ours");
  if (ours == nullptr) return kNotThere;
  table.print();
  Gates gates;
  gates.at_most("our values, bytes", ours->payload, 121);
  gates.at_most("our datagram, authenticated, bytes", ours->datagram, 154);
  gates.ratio(table, *ours, "MAVLink 2 signed, decimal", 0.67);
  gates.ratio(table, *ours, "Cyclone DDS, float", 0.40);
  gates.ratio(table, *ours, "protobuf, float", 0.34);
  gates.at_most("our encoder, ns", *ours->encode_ns, 1'000);
  gates.at_most("our decoder, ns", *ours->decode_ns, 1'000);
  if (json_file != nullptr) {
    std::ofstream out(json_file);
    out << "{\"bench\":\"codec\",\"rows\":" << table.json() << ",\"gates\":" << gates.json()
        << ",\"held\":" << (gates.outcome() == kHeld ? "true" : "false") << "}\n";
    if (!out) {
      std::fprintf(stderr, "%s: cannot be written\n", json_file);
      return kNotThere;
    }
  }
  return gates.outcome();
}

}  // namespace
}  // namespace pitwall::codec

int main(int argc, char** argv) {
  if (argc == 3 && std::strcmp(argv[1], "--json") == 0) return pitwall::codec::run(argv[2]);
  if (argc == 1) return pitwall::codec::run(nullptr);
  std::fprintf(stderr, "usage: %s [--json FILE]\n", argv[0]);
  return pitwall::codec::kNotThere;
}
