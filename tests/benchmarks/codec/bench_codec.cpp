// `bench codec [--json FILE]`: the vehicle state, 84 real numbers, 10 integers and 6 of yes or no,
// over a lap in the encodings that teams send it in; sizes and times.
//   out    a table; exit code 1 when a gate is missed, 2 when a contestant of a gate is not there
//   units  bytes, means over the trace; "on the wire" is with IPv4 and UDP; ns of processor time,
//          best of batches, and beside them what a reference unit costs
//          (tests/benchmarks/cost), by which figures of two machines compare
//   invariants  all bytes are those of the real libraries but JSON's; every frame is read again
//          and compared before a size counts. Times are of C++ alone, in one process and one run
//   gates  sizes as in gates_of(); times: our sealed packet (encoded and sealed; opened and
//          decoded) takes at most kTimesProtobuf times as long as the same values in protobuf
//          sealed by the same cipher, the median of what it is in turns. Protobuf without
//          protection is faster than the cipher alone: that ratio is printed and is no gate
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "protocol/json/json_text.hpp"
#include "protocol/telemetry/packet/header.hpp"
#include "protocol/transport/clock.hpp"
#include "tests/benchmarks/codec/lap.hpp"
#include "tests/benchmarks/codec/peer.hpp"
#include "tests/benchmarks/cost/machine_name.hpp"
#include "tests/benchmarks/cost/paired_ratio.hpp"
#include "tests/benchmarks/cost/reference_cost.hpp"

namespace pitwall::codec {
namespace {

constexpr Duration kTrace = seconds(60), kStep = milliseconds(10);
constexpr std::size_t kBatch = 100, kBatches = 400;
constexpr std::size_t kInCache = 8;  // states of the car, 3 KB each
constexpr std::size_t kLargest = 8'192;
constexpr double kTimesProtobuf = 1.25;
constexpr const char *kOurs = "ours", *kSealed = "ours, sealed",
                     *kSealedProtobuf = "protobuf, float, sealed";
constexpr int kHeld = 0, kMissed = 1, kNotThere = 2;

bool kept(const Peer& contestant, const Values& sent, const Values& read) {
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

// A contestant whose bytes come back as they were; the first packets of the trace, for the times.
struct Timed {
  Peer contestant;
  std::vector<std::vector<std::uint8_t>> written;
  double mean_bytes = 0.0;
  std::vector<double> encode_ns = {}, decode_ns = {};  // batch by batch
};

std::optional<Timed> measure(const Peer& contestant, const std::vector<Values>& trace) {
  Timed timed{.contestant = contestant, .written = {}};
  std::vector<std::uint8_t> buffer(kLargest);
  Values read;
  for (const Values& values : trace) {
    buffer.resize(kLargest);
    buffer.resize(contestant.encode(values, buffer));
    timed.mean_bytes += static_cast<double>(buffer.size()) / static_cast<double>(trace.size());
    if (!contestant.decode(buffer, read) || !kept(contestant, values, read)) return {};
    if (timed.written.size() < kInCache) timed.written.push_back(buffer);
  }
  return timed;
}

// One batch, with values and code in the first cache: the calls that bring them there, after
// another contestant, are not counted.
template <class Work>
double batch_ns(Work&& work) {
  for (std::size_t i = 0; i < kInCache; ++i) work(i);
  const Duration before = transport::thread_time();
  for (std::size_t i = 0; i < kBatch; ++i) work(i % kInCache);
  const Duration took = transport::thread_time() - before;
  return static_cast<double>(took.ns) / static_cast<double>(kBatch);
}

double wire_of(const Measured& m) {
  return m.datagram + static_cast<double>(telemetry::kIpUdpOverhead);
}

class Table {
 public:
  explicit Table(const std::vector<Values>& trace) : trace_(&trace) {}

  void missing(const char* what) { std::printf("not measured: %s\n", what); }
  void add(const Measured& row) { rows_.push_back({row, {}}); }
  // The row, for what is not the encoding's own.
  Measured* add(const Peer& contestant) {
    const auto timed = measure(contestant, *trace_);
    if (!timed) return missing(contestant.name.c_str()), nullptr;
    rows_.push_back({{.name = contestant.name,
                      .bytes_by = contestant.bytes_by,
                      .payload = timed->mean_bytes,
                      .datagram = timed->mean_bytes,
                      .authenticated = false,
                      .encode_ns = {},
                      .decode_ns = {}},
                     timed});
    return &rows_.back().figures;
  }
  // The contestants and the reference unit take turns, batch by batch: what else the machine does
  // meets all of them.
  void measure_times(cost::ReferenceCost& reference) {
    std::vector<std::uint8_t> buffer(kLargest);
    Values read;
    for (std::size_t batch = 0; batch < kBatches; ++batch) {
      reference.take();
      for (auto& [figures, timed] : rows_) {
        if (!timed) continue;
        const Peer& c = timed->contestant;
        timed->encode_ns.push_back(
            batch_ns([&](std::size_t i) { c.encode((*trace_)[i], buffer); }));
        timed->decode_ns.push_back(
            batch_ns([&](std::size_t i) { c.decode(timed->written[i], read); }));
        figures.encode_ns = std::ranges::min(timed->encode_ns);
        figures.decode_ns = std::ranges::min(timed->decode_ns);
      }
    }
  }
  const std::vector<Values>& trace() const { return *trace_; }
  const Measured* find(const std::string& name) const {
    for (const Row& row : rows_)
      if (row.figures.name == name) return &row.figures;
    return nullptr;
  }
  const Timed* times_of(const std::string& name) const {
    for (const Row& row : rows_)
      if (row.figures.name == name && row.timed) return &*row.timed;
    return nullptr;
  }
  void print() const {
    std::printf("%-40s %8s %9s %8s %6s %5s %8s %8s  %s\n", "", "payload", "datagram", "on wire",
                "ours/", "auth", "encode", "decode", "bytes by");
    const double ours = wire_of(rows_.front().figures);
    for (const auto& [row, timed] : rows_) {
      std::printf("%-40s %8.1f %9.1f %8.1f %6.3f %5s %8s %8s  %s\n", row.name.c_str(), row.payload,
                  row.datagram, wire_of(row), ours / wire_of(row), row.authenticated ? "yes" : "no",
                  time_text(row.encode_ns).c_str(), time_text(row.decode_ns).c_str(),
                  row.bytes_by.c_str());
    }
  }
  std::string json() const {
    std::string text;
    for (const auto& [row, timed] : rows_) {
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

  struct Row {
    Measured figures;
    std::optional<Timed> timed;
  };

  const std::vector<Values>* trace_;
  std::vector<Row> rows_;
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
  void size(const Table& table, const std::string& peer, double limit) {
    const Measured* const ours = table.find(kOurs);
    const Measured* const theirs = table.find(peer);
    if (ours == nullptr || theirs == nullptr) return not_there(peer);
    at_most("on the wire, of " + peer, wire_of(*ours) / wire_of(*theirs), limit);
  }
  void times(const Table& table, const std::string& peer, double limit) {
    const Timed* const ours = table.times_of(kSealed);
    const Timed* const theirs = table.times_of(peer);
    if (ours == nullptr || theirs == nullptr) return not_there(peer);
    at_most("encode and seal, times " + peer,
            cost::paired_ratio(ours->encode_ns, theirs->encode_ns), limit);
    at_most("open and decode, times " + peer,
            cost::paired_ratio(ours->decode_ns, theirs->decode_ns), limit);
  }
  int outcome() const { return outcome_; }
  std::string json() const { return "[" + json_ + "]"; }

 private:
  void not_there(const std::string& peer) {
    std::printf("  NOT JUDGED: %s is not there\n", peer.c_str());
    outcome_ = kNotThere;
  }

  int outcome_ = kHeld;
  std::string json_;
};

// What is sealed has so many bytes more than its values.
constexpr double kSeal = telemetry::kHeaderSize + telemetry::kTagSize;

void add_ours(Table& table) {
  constexpr double kValues = telemetry::bytes_of(telemetry::kVehicleStateSet);
  for (const Peer& c : {ours(), sealed(ours(), kSealed)}) {
    Measured* const row = table.add(c);
    if (row == nullptr) continue;
    row->payload = kValues;
    row->authenticated = true;
    if (row->name == kOurs) row->datagram += kSeal;
  }
}

void add_protobuf(Table& table) {
#ifdef CODEC_PROTOBUF
  for (const Peer& c : protobuf()) table.add(c);
  Measured* const row = table.add(sealed(protobuf().front(), kSealedProtobuf));
  if (row == nullptr) return;
  row->payload -= kSeal;
  row->authenticated = true;
#else
  table.missing("protobuf: libprotobuf-dev, protobuf-compiler");
#endif
}

void add_dds(Table& table) {
#ifdef CODEC_FASTCDR
  for (const Peer& c : cdr()) table.add(c);
#else
  table.missing("CDR: libfastcdr-dev");
#endif
#ifdef CODEC_CYCLONE
  if (const auto row = cyclone(table.trace())) {
    table.add(*row);
  } else {
    table.missing("Cyclone DDS: no reader was matched");
  }
#else
  table.missing("Cyclone DDS: cyclonedds-dev, cyclonedds-tools");
#endif
}

void fill(Table& table) {
  add_ours(table);
  const auto signed_forms = mavlink(table.trace());
  for (const Measured& form : signed_forms) table.add(form);
  if (signed_forms.empty()) table.missing("MAVLink 2: npm packages, see ./pitwall setup");
  add_protobuf(table);
#ifdef CODEC_LCM
  if (Measured* const row = table.add(lcm())) row->datagram += static_cast<double>(kLcmHeader);
#else
  table.missing("LCM: liblcm-dev, liblcm-bin");
#endif
  add_dds(table);
#ifdef CODEC_FLATBUFFERS
  table.add(flatbuffers());
#else
  table.missing("FlatBuffers: libflatbuffers-dev, flatbuffers-compiler");
#endif
#ifdef CODEC_CAPNP
  table.add(cap_n_proto());
#else
  table.missing("Cap'n Proto: libcapnp-dev, capnproto");
#endif
  table.add(json());
}

void figure(const Table& table, const std::string& peer) {
  const Measured* const ours = table.find(kSealed);
  const Measured* const theirs = table.find(peer);
  if (ours == nullptr || theirs == nullptr) return;
  std::printf("  no gate encode and seal, open and decode, times %s unsealed: %.1f, %.1f\n",
              peer.c_str(), *ours->encode_ns / *theirs->encode_ns,
              *ours->decode_ns / *theirs->decode_ns);
}

Gates gates_of(const Table& table) {
  Gates gates;
  gates.at_most("our values, bytes", table.find(kOurs)->payload, 121);
  gates.at_most("our datagram, authenticated, bytes", table.find(kOurs)->datagram, 154);
  gates.size(table, "MAVLink 2 signed, decimal", 0.67);
  gates.size(table, "MAVLink 2 signed, decimal, one message", 0.80);
  gates.size(table, "Cyclone DDS, float", 0.40);
  gates.size(table, "protobuf, float", 0.34);
  gates.times(table, kSealedProtobuf, kTimesProtobuf);
  figure(table, "protobuf, float");
  return gates;
}

int run(const char* json_file) {
  const std::vector<Values> trace = lap_of(kTrace, kStep);
  std::printf("84 reals, 10 integers, 6 flags over %.0f s of a lap, %zu frames\n", kTrace.seconds(),
              trace.size());
  Table table(trace);
  fill(table);
  if (table.find(kOurs) == nullptr) return kNotThere;
  cost::ReferenceCost reference;
  table.measure_times(reference);
  table.print();
  const std::string machine = cost::machine_name();
  std::printf("a reference unit: %.1f us; %s\n", reference.unit_us(), machine.c_str());
  const Gates gates = gates_of(table);
  if (json_file != nullptr) {
    std::ofstream out(json_file);
    out << "{\"bench\":\"codec\",\"machine\":" << json::quoted(machine)
        << ",\"unit_us\":" << reference.unit_us() << ",\"rows\":" << table.json()
        << ",\"gates\":" << gates.json()
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
