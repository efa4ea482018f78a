// SPDX-License-Identifier: Apache-2.0
#include "tests/benchmarks/modules/bench_dbc.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <sstream>
#include <tuple>
#include <vector>

#include "protocol/can/av21.hpp"
#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/can/encode.hpp"
#include "protocol/json/json_text.hpp"
#include "protocol/transport/clock.hpp"
#include "protocol/transport/file.hpp"
#include "protocol/transport/process.hpp"
#include "protocol/vocabulary/random.hpp"
#include "tests/benchmarks/command_line.hpp"
#include "tests/benchmarks/modules/synthetic_dbc.hpp"

namespace pitwall::benchmarks {
namespace {

constexpr const char* kDatabase = "protocol/can/dbc/av21.dbc";
constexpr double kLeastDecoded_per_s = 20e6;
constexpr double kParseLimit_ms = 100.0;
constexpr std::size_t kLargeFile_bytes = 800'000;
constexpr int kRuns = 7;
constexpr std::size_t kFramesPerMessage = 32;
constexpr int kRounds = 400;  // over all frames, in one run
constexpr Duration kPeerLimit = seconds(120);
constexpr std::uint64_t kSeed = 14;

// Loads a database, then decodes random payloads of every message of another one.
constexpr const char* kPeer = R"(
import random, sys, time
import canmatrix.formats
begun = time.perf_counter()
canmatrix.formats.loadp_flat(sys.argv[1])
parse_s = time.perf_counter() - begun
frames = [f for f in canmatrix.formats.loadp_flat(sys.argv[2]).frames if f.size > 0]
rng = random.Random(14)
work = [(f, bytes(rng.randrange(256) for _ in range(f.size))) for f in frames for _ in range(20)]
begun = time.perf_counter()
count = sum(len(f.decode(payload)) for f, payload in work)
print(parse_s * 1e3, count / (time.perf_counter() - begun))
)";

struct Work {
  std::vector<can::Frame> frames;           // of all messages, one after the other
  std::vector<std::vector<double>> values;  // of each frame
  std::size_t signals = 0;                  // in one round
};

Work work_for(const can::Database& database) {
  Work work;
  Random random{kSeed};
  for (std::size_t i = 0; i < kFramesPerMessage; ++i) {
    for (const can::Message& m : database.messages) {
      can::Frame f{.id = m.id, .length = static_cast<std::uint8_t>(m.length), .data = {}};
      for (std::size_t b = 0; b < m.length; ++b)
        f.data[b] = static_cast<std::uint8_t>(random.next());
      work.frames.push_back(f);
      work.values.emplace_back(m.signals.size());
      CHECK(can::decode(m, f, work.values.back()));
      work.signals += m.signals.size();
    }
  }
  return work;
}

// Signals a second in each run; a run is many rounds over all frames.
template <class Round>
std::vector<double> rates_of(const Work& work, Round round) {
  std::vector<double> rates;
  for (int run = 0; run < kRuns; ++run) {
    const Instant begun = transport::monotonic_now();
    for (int i = 0; i < kRounds; ++i) round();
    rates.push_back(static_cast<double>(work.signals) * kRounds /
                    (transport::monotonic_now() - begun).seconds());
  }
  std::sort(rates.begin(), rates.end());
  return rates;
}

// What the compiler may not leave out.
struct Sum {
  volatile double value = 0.0;
  void add(double v) { value = value + v; }
};

// The generated code of every message behind its id, like the run-time index.
struct Generated {
  using Decode = void (*)(const can::Frame&, Sum&);
  using Encode = void (*)(const std::vector<double>&, can::Frame&, can::EncodeCounters&);
  std::array<Decode, can::kMaxStandardId + 1> decode{};
  std::array<Encode, can::kMaxStandardId + 1> encode{};

  Generated() {
    std::apply([this](auto... message) { (add<decltype(message)>(), ...); },
               can::av21::AllMessages{});
  }

 private:
  template <class X>
  void add() {
    decode[X::kId] = [](const can::Frame& frame, Sum& sum) {
      X x;
      if (!can::av21::decode(frame, x)) return;
      double total = 0.0;
      for (const auto field : X::kFields) total += x.*field;
      sum.add(total);
    };
    encode[X::kId] = [](const std::vector<double>& values, can::Frame& out,
                        can::EncodeCounters& counters) {
      X x;
      for (std::size_t k = 0; k < values.size(); ++k) x.*X::kFields[k] = values[k];
      CHECK(can::av21::encode(x, out, counters));
    };
  }
};

struct Rates {
  std::vector<double> plans_decode, generated_decode, plans_encode, generated_encode;
};

Rates measure_rates(const can::Database& database, const Work& work) {
  Rates rates;
  Sum sum;
  const can::MessageIndex index{database};
  const Generated generated;
  std::array<double, 64> values{};
  rates.plans_decode = rates_of(work, [&] {
    for (const can::Frame& f : work.frames) {
      const can::Message& m = *index.find(f.id, f.extended);
      const std::span<double> mine{values.data(), m.signals.size()};
      CHECK(can::decode(m, f, mine));
      double total = 0.0;
      for (const double v : mine) total += v;
      sum.add(total);
    }
  });
  rates.generated_decode = rates_of(work, [&] {
    for (const can::Frame& f : work.frames) generated.decode[f.id](f, sum);
  });
  can::EncodeCounters counters;
  can::Frame out;
  rates.plans_encode = rates_of(work, [&] {
    for (std::size_t i = 0; i < work.frames.size(); ++i) {
      CHECK(can::encode(*index.find(work.frames[i].id), work.values[i], out, counters));
    }
  });
  rates.generated_encode = rates_of(work, [&] {
    for (std::size_t i = 0; i < work.frames.size(); ++i) {
      generated.encode[work.frames[i].id](work.values[i], out, counters);
    }
  });
  return rates;
}

std::vector<double> parse_times_ms(const std::string& text) {
  std::vector<double> times;
  for (int run = 0; run < kRuns; ++run) {
    const Instant begun = transport::monotonic_now();
    const auto database = can::parse_dbc(text, "synthetic.dbc");
    times.push_back((transport::monotonic_now() - begun).seconds() * 1e3);
    CHECK(database.has_value());
  }
  std::sort(times.begin(), times.end());
  return times;
}

struct Peer {
  double parse_ms = 0.0, decoded_per_s = 0.0;
};

// Nothing where canmatrix is not installed or does not answer.
std::optional<Peer> ask_peer(const std::string& large) {
  const auto folder = transport::TemporaryFolder::create("pitwall-bench-dbc-");
  if (!folder) return std::nullopt;
  const std::string file = folder->path() + "/large.dbc", script = folder->path() + "/peer.py";
  if (!transport::write_file(file, large) || !transport::write_file(script, kPeer)) {
    return std::nullopt;
  }
  auto process = transport::Process::spawn(
      {.argv = {"sh", "-c",
                "exec /usr/bin/python3 \"$0/peer.py\" \"$0/large.dbc\" \"$1\" "
                "> \"$0/out\" 2> \"$0/err\"",
                folder->path(), kDatabase}});
  if (!process) return std::nullopt;
  const auto status = process->wait_until(transport::monotonic_now() + kPeerLimit);
  if (!status || !status->success()) return std::nullopt;
  std::istringstream figures{transport::read_file(folder->path() + "/out").value_or("")};
  Peer peer;
  figures >> peer.parse_ms >> peer.decoded_per_s;
  return figures ? std::optional{peer} : std::nullopt;
}

double median(const std::vector<double>& sorted) { return sorted[sorted.size() / 2]; }

void print_rates(const char* name, const std::vector<double>& sorted) {
  std::printf("%-26s %10.1f %10.1f %10.1f\n", name, sorted.front() * 1e-6, median(sorted) * 1e-6,
              sorted.back() * 1e-6);
}

struct Figures {
  Rates rates;
  std::vector<double> parse_ms;
  std::size_t large_bytes = 0;
  std::optional<Peer> peer;

  bool decode_held() const { return median(rates.plans_decode) >= kLeastDecoded_per_s; }
  bool parse_held() const { return median(parse_ms) < kParseLimit_ms; }
};

void print(const Figures& f) {
  std::printf("million signals/s on one core, all messages of %s, %d runs\n%-26s %10s %10s %10s\n",
              kDatabase, kRuns, "", "least", "median", "most");
  print_rates("decode, run-time plans", f.rates.plans_decode);
  print_rates("decode, generated code", f.rates.generated_decode);
  print_rates("encode, run-time plans", f.rates.plans_encode);
  print_rates("encode, generated code", f.rates.generated_encode);
  std::printf("reading %zu bytes of DBC, ms %12.1f %10.1f %10.1f\n", f.large_bytes,
              f.parse_ms.front(), median(f.parse_ms), f.parse_ms.back());
  if (f.peer) {
    std::printf(
        "peer, canmatrix: reads the same in %.0f ms (%.0f times as long), decodes %.3f "
        "million signals/s (1/%.0f)\n",
        f.peer->parse_ms, f.peer->parse_ms / median(f.parse_ms), f.peer->decoded_per_s * 1e-6,
        median(f.rates.plans_decode) / f.peer->decoded_per_s);
  } else {
    std::printf("peer, canmatrix: not here (python3-canmatrix)\n");
  }
  std::printf("gate: run-time plans decode at least %.0f million signals/s: %s\n",
              kLeastDecoded_per_s * 1e-6, f.decode_held() ? "held" : "MISSED");
  std::printf("gate: %zu kB are read in less than %.0f ms: %s\n", kLargeFile_bytes / 1000,
              kParseLimit_ms, f.parse_held() ? "held" : "MISSED");
}

std::string json_of(const Figures& f) {
  json::Object out;
  out.text("bench", "dbc")
      .number("decode_plans_per_s", median(f.rates.plans_decode))
      .number("decode_generated_per_s", median(f.rates.generated_decode))
      .number("encode_plans_per_s", median(f.rates.plans_encode))
      .number("encode_generated_per_s", median(f.rates.generated_encode))
      .number("parse_bytes", f.large_bytes)
      .number("parse_ms", median(f.parse_ms));
  if (f.peer)
    out.json("canmatrix", json::Object{}
                              .number("parse_ms", f.peer->parse_ms)
                              .number("decode_per_s", f.peer->decoded_per_s)
                              .str());
  return out.number("gate_decode_per_s", kLeastDecoded_per_s)
             .number("gate_parse_ms", kParseLimit_ms)
             .flag("held", f.decode_held() && f.parse_held())
             .str() +
         "\n";
}

}  // namespace

int bench_dbc(std::span<const std::string> args) {
  std::string json_file;
  CommandLine app{"pitwall-benchmarks dbc: reading CAN databases and decoding frames"};
  app.option("--json", json_file, "write the figures here");
  if (const auto code = app.ended_by(args)) return *code;
  const auto text = transport::read_file(kDatabase, can::kMaxDbcBytes);
  if (!text) return refuse(text.error());
  const auto database = can::parse_dbc(*text, kDatabase);
  if (!database) return refuse(database.error());
  const std::string large = synthetic_dbc(kLargeFile_bytes);
  const Figures figures{measure_rates(*database, work_for(*database)), parse_times_ms(large),
                        large.size(), ask_peer(large)};
  print(figures);
  if (!json_file.empty()) {
    const auto written = transport::write_file(json_file, json_of(figures));
    if (!written) return refuse(written.error());
  }
  return figures.decode_held() && figures.parse_held() ? kExitPass : kExitFailed;
}

}  // namespace pitwall::benchmarks
