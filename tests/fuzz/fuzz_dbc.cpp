// SPDX-License-Identifier: Apache-2.0
// Any text is a database or an error with a place; a database survives any frame.
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/decode.hpp"
#include "protocol/can/encode.hpp"
#include "protocol/vocabulary/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace pitwall::can;
  const std::string_view text{reinterpret_cast<const char*>(bytes), size};
  const auto database = parse_dbc(text, "f.dbc");
  if (!database) {
    CHECK(database.error().place.starts_with("f.dbc:"));
    return 0;
  }
  for (const Message& m : database->messages) {
    CHECK(!contradiction(m));
    Frame frame{.id = m.id,
                .extended = m.extended,
                .remote = false,
                .fd = m.fd,
                .length = m.length,
                .data = {}};
    for (std::size_t i = 0; i < m.length && i < size; ++i) frame.data[i] = bytes[size - 1 - i];
    std::vector<double> values(m.signals.size());
    CHECK(decode(m, frame, values));
    EncodeCounters counters;
    Frame back;
    (void)encode(m, values, back, counters);
  }
  CHECK(fingerprint(*database) == fingerprint(*database));
  return 0;
}
