// Seven messages of real NovAtel OEM7 receivers, byte for byte: reference data from the recordings
// align.gps and bestpos.gps in novatel/novatel_oem7_driver at 0c0e135, test (MIT, Copyright (c)
// NovAtel Inc.). The values that the vendor's driver decodes from them are in the tests.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <charconv>
#include <cstdint>
#include <string_view>
#include <vector>

namespace pitwall::recordings {

// align.gps, byte 0
inline constexpr std::string_view kHeading2 =
    "aa44121c370500203000000052b42a08b80c551820080002841600800000000032000000000080bf253b4343"
    "0080a7bc0000000001d50c3d18e3653d4c3430584c343058151515150401003386f18e17";
// bestpos.gps, byte 104: the short form
inline constexpr std::string_view kInsPvaS =
    "aa441358fc015608f0c7331e560800000000000058ed1e4169a3b78c419349407e846ebff6815cc000e0fa06"
    "63d49040cc37e371eef6613f0a57a92a40f17d3f0cb4dfcc82ab92bf00000000000000000000000000000000"
    "0000000000000080010000004a856add";
// bestpos.gps, byte 208
inline constexpr std::string_view kBestPos =
    "aa44121c2a0000204800000096b45608f0c7331e20000402f6b100800000000010000000d34bee8b41934940"
    "5c017abff6815cc00020a37065189140000088c13d0000000e71f53fcadfd73fc1ff65400000000000000000"
    "0000000010101000000000111059f44e";
// bestpos.gps, byte 312: same epoch as kBestPos
inline constexpr std::string_view kBestVel =
    "aa44121c630000202c00000096b45608f0c7331e20000402a210008000000000080000000000000000000000"
    "a5f396dea166723f54bbeae8ef9b564093f5582c84d666bf0000000013deab93";
// bestpos.gps, byte 664
inline constexpr std::string_view kInsPvaX =
    "aa44121cb90500207e0000008fb45608c0cf331e200004021d4700800700000010000000b6a9758c41934940"
    "ba5645c0f6815cc000e0206dc2189140000088c1703858702758803fe0a00150cfa070bf668b5612039db43f"
    "0182fab5bbd1f6bf08d0fa5f6814f2bfeb1dc12a168056400170f53f91ded73fc9006640e3ae6a3e1f694e3e"
    "cdecdb3e00004040000040400000004100000011010083dedbf6";
// bestpos.gps, byte 822: same epoch as kInsPvaX
inline constexpr std::string_view kBestPosOfInsPvaX =
    "aa44121c2a000020480000008fb45608c0cf331e20000402f6b10080000000001000000038f9aa8b41934940"
    "cc7f98c0f6815cc00000e3826c189140000088c13d000000cb6ef53f37ddd73fd90166400000000000000000"
    "00000000101010000000001107cd1455";
// bestpos.gps, byte 1002: same epoch as kInsPvaX
inline constexpr std::string_view kBestUtm =
    "aa44121cd6020020500000008fb45608c0cf331e200004020aa4008000000000100000000b00000055000000"
    "83fdf3acd6a15541e8f1cbb79a9825410000e3826c189140000088c13d000000cb6ef53f37ddd73fd9016640"
    "00000000000000000000000010101000000000115c030cf3";

inline constexpr std::string_view kNovatelFrames[]{kHeading2, kInsPvaS,          kBestPos, kBestVel,
                                                   kInsPvaX,  kBestPosOfInsPvaX, kBestUtm};

inline std::vector<std::uint8_t> bytes_of_hex(std::string_view hex) {
  std::vector<std::uint8_t> bytes(hex.size() / 2);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    std::from_chars(hex.data() + 2 * i, hex.data() + 2 * i + 2, bytes[i], 16);
  return bytes;
}

}  // namespace pitwall::recordings
