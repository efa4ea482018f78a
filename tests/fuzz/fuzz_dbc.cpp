// SPDX-License-Identifier: Apache-2.0
// Any text is a database or an error with a place; a database survives any frame and any values,
// is no different from itself, and what it encodes it decodes again. What a strict reading accepts,
// a lenient one reads the same and without errors; what it refuses, a lenient one tells.
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/can/difference.hpp"
#include "protocol/can/encode.hpp"
#include "protocol/can/overlap.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall::can;

// Numbers of every size and sign, NaN and infinity among them, made of the text itself.
double value_from(const std::uint8_t* bytes, std::size_t size, std::size_t at) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < 8; ++i) bits = bits << 8U | bytes[(at + i) % size];
  return at % 2 == 0 ? std::bit_cast<double>(bits) : static_cast<double>(bits % 1000) - 500.0;
}

bool is_integer(const Signal& s) {
  return s.layout.number == Number::kUnsigned || s.layout.number == Number::kSigned;
}

void exercise(const Message& m, const std::uint8_t* bytes, std::size_t size) {
  Frame frame{.id = m.id,
              .extended = m.extended,
              .remote = false,
              .fd = m.fd,
              .length = static_cast<std::uint8_t>(m.length),
              .data = {}};
  for (std::size_t i = 0; i < m.length; ++i) frame.data[i] = bytes[(size - 1 - i % size)];
  std::vector<double> values(m.signals.size());
  CHECK(decode(m, frame, values));
  EncodeCounters counters;
  Frame back;
  (void)encode(m, values, back, counters);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = value_from(bytes, size, i);
  if (!encode(m, values, back, counters)) return;
  CHECK(decode(m, back, values));
  // Encoding what was decoded changes nothing: every value is one that the field can hold.
  Frame again;
  if (!encode(m, values, again, counters)) return;  // an overflow to infinity
  for (const Signal& s : m.signals) {
    const SignalPlan& p = s.plan;
    const bool is_exact = m.flaws.empty() && is_integer(s) && p.length <= 32 &&
                          std::abs(p.offset / p.scale) < 0x1p20 && is_present(m, s, back) &&
                          is_present(m, s, again) && p.scale > 1e-100 && p.scale < 1e100;
    CHECK(!is_exact || extract(p, back.data) == extract(p, again.data));
  }
}

// Whatever is left of a text that is full of errors can be decoded, encoded and compared.
void exercise_leniently(const Database& d, const std::uint8_t* bytes, std::size_t size) {
  const MessageIndex index{d};
  for (const Message& m : d.messages) {
    CHECK(index.find(m.id, m.extended) == &m && d.find(m.id, m.extended) == &m);
    if (m.is_on_frame()) {
      exercise(m, bytes, size);
      continue;
    }
    Frame frame{.id = m.id, .extended = m.extended, .remote = false, .fd = false, .data = {}};
    EncodeCounters counters;
    std::vector<double> values(m.signals.size());
    CHECK(!decode(m, frame, values) && !encode(m, values, frame, counters));
  }
  for (const Finding& f : d.findings) {
    CHECK(f.place.starts_with("f.dbc:") && !f.what.empty());
    CHECK((severity_of(f.kind) == FindingSeverity::kError) == !f.outcome.empty());
  }
  CHECK(differences(d, d).empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const std::string_view text{reinterpret_cast<const char*>(bytes), size};
  const auto lenient = parse_dbc_leniently(text, "f.dbc");
  const auto database = parse_dbc(text, "f.dbc");
  CHECK(database.has_value() == (lenient && lenient->count(FindingSeverity::kError) == 0));
  if (lenient) exercise_leniently(*lenient, bytes, size);
  if (!database) {
    CHECK(database.error().place.starts_with("f.dbc:"));
    return 0;
  }
  CHECK(fingerprint(*database) == fingerprint(*lenient));
  for (const Message& m : database->messages) {
    CHECK(m.is_on_frame() && m.flaws.empty() && overlaps(m).empty());
  }
  CHECK(differences(*database, *lenient).empty());
  // Against the same file without its second half, both ways round.
  const auto half = parse_dbc(text.substr(0, size / 2), "f.dbc");
  if (!half) return 0;
  CHECK(differences(*database, *half).empty() == differences(*half, *database).empty());
  CHECK(fingerprint(*database) == fingerprint(*half) || !differences(*database, *half).empty());
  return 0;
}
