// SPDX-License-Identifier: Apache-2.0
// Any text is a manifest or an error with a place; joined with a database it has no contradiction
// or a named one, and where it has none every rule protects its message and finds a flipped bit.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "protocol/can/dbc_parser.hpp"
#include "protocol/can/e2e.hpp"
#include "protocol/can/manifest.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall::can;

constexpr const char* kDatabase = R"(BO_ 1 M: 8 A
 SG_ a : 0|8@1+ (1,0) [0|0] "" A
 SG_ n : 8|4@1+ (1,0) [0|0] "" A
 SG_ i : 12|4@1+ (1,0) [0|0] "" A
 SG_ w : 16|16@1+ (1,0) [0|0] "" A
 SG_ c : 32|8@1+ (1,0) [0|0] "" A
 SG_ m : 47|8@0+ (1,0) [0|0] "" A
 SG_ s : 55|16@0- (0.1,5) [0|0] "" A
)";

void use(const ProtectionRule& rule) {
  Frame frame{.id = 1, .length = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};
  ProtectState state;
  for (int sends = 0; sends < 3; ++sends) {
    protect(rule, state, frame);
    CHECK(check(rule, frame) == FrameCheck::kOk);
  }
  if (rule.profile == Protection::kNone) return;
  for (std::size_t bit = 0; bit < 64; ++bit) {
    Frame bad = frame;
    bad.data[bit / 8] = static_cast<std::uint8_t>(bad.data[bit / 8] ^ 1U << bit % 8);
    CHECK(check(rule, bad) != FrameCheck::kOk);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const Database database = parse_dbc(kDatabase, "f.dbc").value();
  const std::string_view text{reinterpret_cast<const char*>(bytes), size};
  const auto manifest = parse_manifest(text, "f.yaml");
  if (!manifest) {
    CHECK(manifest.error().place.starts_with("f.yaml"));
    return 0;
  }
  if (const auto problem = contradiction(*manifest, database)) {
    CHECK(problem->place.starts_with("f."));
    return 0;
  }
  const auto table = rows(*manifest, database);
  CHECK(table.size() == 1);
  use(table[0].protection);
  return 0;
}
