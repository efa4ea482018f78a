// SPDX-License-Identifier: Apache-2.0
// Many starts of one car while no base is there: car_starts KEYS ADDRESS COUNT. Each start is a
// car's end of the radio with the keys, sends its first opening to the address, and is gone.
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "protocol/transport/clock.hpp"
#include "tests/support/car_radio.hpp"

namespace pitwall {
namespace {

constexpr std::size_t kTogether = 50;
constexpr Duration kTick = milliseconds(2), kTimeout = seconds(2);

Result<bool, Problem> start(const std::vector<std::string>& words, std::size_t count) {
  std::vector<testing::CarRadio> cars;
  for (std::size_t i = 0; i < count; ++i) {
    auto radio = testing::CarRadio::open(words);
    if (!radio) return Unexpected{radio.error()};
    cars.push_back(*std::move(radio));
  }
  // Until the budget of each has let its opening go.
  const Instant end = transport::monotonic_now() + kTimeout;
  for (Instant tick = end - kTimeout; !cars.empty(); tick = tick + kTick) {
    if (tick > end) return Unexpected{Problem{words[1], "a car sends no opening"}};
    std::erase_if(cars, [](testing::CarRadio& car) { return car.send({}) > 0; });
    transport::sleep_until(tick + kTick);
  }
  return true;
}

int run(const std::vector<std::string>& words) {
  for (std::size_t left = std::stoul(words[2]); left > 0;) {
    const std::size_t count = std::min(left, kTogether);
    if (const auto started = start(words, count); !started) {
      std::fprintf(stderr, "%s\n", to_string(started.error()).c_str());
      return 1;
    }
    left -= count;
  }
  return 0;
}

}  // namespace
}  // namespace pitwall

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  return words.size() == 3 ? pitwall::run(words) : 2;
}
