// SPDX-License-Identifier: Apache-2.0
#include <array>

#include "tests/system/radio_explorer/world.hpp"

namespace pitwall::explorer {

const char* text_of(Action action) {
  constexpr std::array<const char*, kActions> kTexts{"A commands",
                                                     "B commands",
                                                     "stop is pressed",
                                                     "release is given",
                                                     "A takes authority",
                                                     "authority changes",
                                                     "authority is renewed",
                                                     "base sends",
                                                     "car sends",
                                                     "car hears packet 1",
                                                     "car hears packet 2",
                                                     "car hears packet 3",
                                                     "car hears a copy of packet 1",
                                                     "car hears a copy of packet 2",
                                                     "car hears a copy of packet 3",
                                                     "packet 1 is lost",
                                                     "packet 2 is lost",
                                                     "base hears packet 1",
                                                     "base hears packet 2",
                                                     "packet 1 of the car is lost",
                                                     "command goes to the consumer",
                                                     "consumer applies",
                                                     "time passes",
                                                     "base restarts",
                                                     "car restarts",
                                                     "base moves",
                                                     "car probes the address on trial",
                                                     "a relay delivers packet 1 first"};
  return kTexts[static_cast<std::size_t>(action)];
}

const char* text_of(Broken broken) {
  constexpr std::array kTexts{
      "nothing",
      "a command was applied twice",
      "a command was applied after its time",
      "a command was applied without authority",
      "an older command was applied after a newer one",
      "the base was told a wrong fate",
      "the car takes somebody for the holder who is not",
      "the stop went by itself",
      "a press that was heard is not latched",
      "a press was forgotten at the base",
      "the car believes an address that proved nothing, or a relay beside the base",
      "the base is where the car was told and is not found"};
  return kTexts[static_cast<std::size_t>(broken)];
}

}  // namespace pitwall::explorer
