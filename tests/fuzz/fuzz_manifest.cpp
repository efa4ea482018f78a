// SPDX-License-Identifier: Apache-2.0
// Any text is a manifest or an error with a place; joined with a database it has no contradiction
// or a named one.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/check.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  using namespace pitwall::can;
  static const Database database =
      parse_dbc("BO_ 1 M: 8 A\n SG_ a : 0|8@1+ (1,0) [0|0] \"\" A\n", "f.dbc").value();
  const std::string_view text{reinterpret_cast<const char*>(bytes), size};
  const auto manifest = parse_manifest(text, "f.yaml");
  if (!manifest) {
    CHECK(manifest.error().place.starts_with("f.yaml"));
    return 0;
  }
  if (!contradiction(*manifest, database)) CHECK(rows(*manifest, database).size() == 1);
  return 0;
}
