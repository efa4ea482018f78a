// SPDX-License-Identifier: Apache-2.0
// What a Foxglove client may say, as text or as bytes: nothing breaks, and whatever it was, the
// registry says no more to it than it was asked, and nothing to anybody else.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "basestation/publishers/foxglove/client_registry.hpp"
#include "protocol/vocabulary/check.hpp"

namespace {

using namespace pitwall::publishers::foxglove;

constexpr pitwall::publishers::web::ClientId kClient = 16, kOther = 17;
constexpr std::size_t kMostAnswers = 64 * 1'024;

ClientRegistry registry_of_two() {
  ClientRegistry registry{{.name = "fuzz", .session = "s"},
                          {{.topic = "/a"}, {.topic = "/b", .latched = true}}};
  registry.joined(kClient);
  registry.joined(kOther);
  registry.message(1, {}, {});
  registry.take();
  return registry;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const ClientRegistry kFresh = registry_of_two();
  ClientRegistry registry = kFresh;
  CHECK(!registry.receive_text(kClient, {reinterpret_cast<const char*>(data), size}));
  CHECK(!registry.receive_bytes(kClient, {data, size}));
  std::size_t answers = 0;
  for (const Sending& sending : registry.take()) {
    CHECK(!sending.to.test(kOther));
    ++answers;
  }
  CHECK(answers <= kMostAnswers);
  return 0;
}
