// Synthetic CAN bus with end-to-end protection: messages of 8 bytes each 10 ms, which use in turn
// profile 1 (both, alternating, low, nibble), profiles 2 and 5, SAE J1850, a counter only, and no
// protection. 270 messages are 27,000 frames a second, as on three buses of 1 Mbit/s.
//   in      the number of messages, up to 1024
//   out     the texts of a DBC file and of its manifest; the same for the same number
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

namespace pitwall {

struct BusTexts {
  std::string dbc, manifest;
};

inline std::string integrity_checksum(int kind, int index) {
  constexpr std::array<const char*, 4> kModes{"both", "alternating", "low", "nibble"};
  const std::string low = std::to_string(index % 256);
  if (kind < 4) {
    const std::string id = kind == 2 ? low : std::to_string(256 * (1 + index % 8) + index % 200);
    return std::string{"{profile: e2e_p01, signal: crc, data_id: "} + id +
           ", data_id_mode: " + kModes[static_cast<std::size_t>(kind)] +
           (kind == 3 ? ", data_id_nibble: rest}" : "}");
  }
  if (kind == 4) {
    std::string ids = low;
    for (int i = 1; i < 16; ++i) ids += ", " + std::to_string((index + 64 * i + i) % 256);
    return "{profile: e2e_p02, signal: crc, data_ids: [" + ids + "]}";
  }
  if (kind == 5) return "{profile: e2e_p05, signal: crc, data_id: " + std::to_string(index) + "}";
  return kind == 6 ? "{profile: sae_j1850, signal: crc}" : "";
}

inline BusTexts integrity_bus(int messages) {
  constexpr int kKinds = 9, kFirstId = 512, kP05 = 5, kPlain = 8;
  BusTexts out{"VERSION \"\"\nNS_ :\nBS_:\nBU_: A\n",
               "database: integrity_bus.dbc\nrevision: R\nmessages:\n"};
  for (int i = 0; i < messages; ++i) {
    const int kind = i % kKinds;
    const std::string name = "m" + std::to_string(i);
    const std::string end = " (1,0) [0|0] \"\" A\n";
    out.dbc += "BO_ " + std::to_string(kFirstId + i) + " " + name + ": 8 A\n";
    out.dbc += std::string{" SG_ crc : "} + (kind == kP05 ? "0|16@1+" : "0|8@1+") + end;
    out.dbc += std::string{" SG_ counter : "} + (kind == kP05 ? "16|8@1+" : "8|4@1+") + end;
    if (kind != kP05) out.dbc += " SG_ rest : 12|4@1+" + end;
    out.dbc += " SG_ value : 32|32@1-" + end;
    const std::string checksum = integrity_checksum(kind, i);
    out.manifest += "  " + name +
                    ":\n    direction: from_car\n    safety: status\n    period_ms: 10\n"
                    "    timeout_ms: 50\n";
    if (kind != kPlain) out.manifest += "    counter: counter\n";
    if (!checksum.empty()) out.manifest += "    checksum: " + checksum + "\n";
  }
  return out;
}

}  // namespace pitwall
