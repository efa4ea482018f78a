// SPDX-License-Identifier: Apache-2.0
// Sentences that receivers of NovAtel and its manual wrote, each with its checksum, against the
// values that stand in them; then the law that what is written reads back.
#include "protocol/gnss/novatel_ascii.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "protocol/bits/crc.hpp"
#include "protocol/gnss/novatel_stream.hpp"
#include "protocol/vocabulary/bytes.hpp"
#include "tests/protocol/gnss/random_messages.hpp"

namespace pitwall::gnss {
namespace {

struct ReceivedSentence {
  NovatelHeader header;
  std::optional<NovatelMessage> message;
  std::optional<DecodeError> refusal;
};

std::vector<ReceivedSentence> sentences_of(const std::string& text) {
  std::vector<ReceivedSentence> all;
  NovatelStream stream;
  stream.feed(as_bytes(text), [&](const NovatelFrame& frame) {
    EXPECT_TRUE(frame.ascii);
    const auto decoded = decode(frame);
    ReceivedSentence received{.header = frame.header, .message = {}, .refusal = {}};
    if (decoded) {
      received.message = *decoded;
    } else {
      received.refusal = decoded.error();
    }
    all.push_back(received);
  });
  return all;
}

template <class Message>
std::pair<NovatelHeader, Message> only(const std::string& sentence) {
  const auto received = sentences_of(sentence + "\r\n");
  EXPECT_EQ(received.size(), 1U) << sentence;
  if (received.size() != 1 || !received[0].message) {
    ADD_FAILURE() << "refused: " << sentence;
    return {};
  }
  EXPECT_EQ(received[0].header.id, Message::kId);
  return {received[0].header, std::get<Message>(*received[0].message)};
}

// A recording of a receiver (tests of a driver of the Southwest Research Institute).
TEST(NovatelAscii, BestPos) {
  const auto [h, m] = only<BestPos>(
      "#BESTPOSA,COM1,0,74.0,FINESTEERING,1687,420221.000,00000000,6145,3153;SOL_COMPUTED,SINGLE,"
      "32.59536697319,-85.29568091247,199.8451,-29.2000,WGS84,1.2596,1.1674,2.6585,\"\",0.000,0."
      "000,"
      "12,11,0,0,0,06,00,03*703fb123");
  EXPECT_EQ(h.port, 0x20);
  EXPECT_EQ(h.idle_time, 148);
  EXPECT_EQ(h.time_status, 180);
  EXPECT_EQ(h.week, 1687);
  EXPECT_EQ(h.milliseconds, 420'221'000U);
  EXPECT_EQ(h.reserved, 0x6145);
  EXPECT_EQ(h.receiver_version, 3153);
  EXPECT_EQ(m.solution_status, 0U);
  EXPECT_EQ(m.position_type, 16U);
  EXPECT_EQ(m.latitude_deg, 32.59536697319);
  EXPECT_EQ(m.longitude_deg, -85.29568091247);
  EXPECT_EQ(m.height_m, 199.8451);
  EXPECT_EQ(m.undulation_m, -29.2F);
  EXPECT_EQ(m.datum, 61U);
  EXPECT_EQ(m.latitude_sigma_m, 1.2596F);
  EXPECT_EQ(m.longitude_sigma_m, 1.1674F);
  EXPECT_EQ(m.height_sigma_m, 2.6585F);
  EXPECT_EQ(m.station, (std::array<char, 4>{}));
  EXPECT_EQ(m.satellites_tracked, 12);
  EXPECT_EQ(m.satellites_used, 11);
  EXPECT_EQ(m.extended_status, 0x06);
  EXPECT_EQ(m.gps_glonass_mask, 0x03);
}

TEST(NovatelAscii, BestVel) {
  const auto [h, m] = only<BestVel>(
      "#BESTVELA,USB1,0,73.3,FINESTEERING,2076,112838.000,00000000,000e,10558;SOL_COMPUTED,"
      "DOPPLER_VELOCITY,0.000,1.000,8.6437,77.431308,0.0275,0.0*d771d968");
  EXPECT_EQ(h.port, 0);  // a port of 16 bits
  EXPECT_EQ(m.velocity_type, 8U);
  EXPECT_EQ(m.differential_age_s, 1.0F);
  EXPECT_EQ(m.horizontal_mps, 8.6437);
  EXPECT_EQ(m.track_over_ground_deg, 77.431308);
  EXPECT_EQ(m.vertical_mps, 0.0275);
}

TEST(NovatelAscii, Heading2) {
  const auto [h, m] = only<Heading2>(
      "#HEADING2A,COM1,0,39.5,FINESTEERING,1622,422892.200,02040000,f9bf,6521;SOL_COMPUTED,"
      "NARROW_INT,0.927607417,178.347869873,-1.3037414550,0,0.261901051,0.391376048,\"R222\","
      "\"AAAA\","
      "18,17,17,16,0,01,0,33*8c48d77c");
  EXPECT_EQ(h.milliseconds, 422'892'200U);
  EXPECT_EQ(h.idle_time, 79);
  EXPECT_EQ(m.position_type, 50U);
  EXPECT_EQ(m.baseline_m, 0.927607417F);
  EXPECT_EQ(m.heading_deg, 178.347869873F);
  EXPECT_EQ(m.pitch_deg, -1.303741455F);
  EXPECT_EQ(m.heading_sigma_deg, 0.261901051F);
  EXPECT_EQ(m.pitch_sigma_deg, 0.391376048F);
  EXPECT_EQ(m.rover_station, (std::array{'R', '2', '2', '2'}));
  EXPECT_EQ(m.master_station, (std::array{'A', 'A', 'A', 'A'}));
  EXPECT_EQ(m.satellites_multi, 16);
  EXPECT_EQ(m.extended_status, 0x01);
  EXPECT_EQ(m.gps_glonass_mask, 0x33);
}

// The manual's example.
TEST(NovatelAscii, DualAntennaHeading) {
  const auto [h, m] = only<DualAntennaHeading>(
      "#DUALANTENNAHEADINGA,UNKNOWN,0,66.5,FINESTEERING,1949,575614.000,02000000,d426,32768;"
      "SOL_COMPUTED,NARROW_INT,-1.000000000,255.538528442,0.006041416,0.0,0.043859947,0.052394450,"
      "\"J56X\",24,18,18,17,04,01,00,33*1f082ec5");
  EXPECT_EQ(m.baseline_m, -1.0F);
  EXPECT_EQ(m.heading_deg, 255.538528442F);
  EXPECT_EQ(m.pitch_deg, 0.006041416F);
  EXPECT_EQ(m.heading_sigma_deg, 0.043859947F);
  EXPECT_EQ(m.pitch_sigma_deg, 0.05239445F);
  EXPECT_EQ(m.station, (std::array{'J', '5', '6', 'X'}));
  EXPECT_EQ(m.satellites_tracked, 24);
  EXPECT_EQ(m.solution_source, 0x04);
  EXPECT_EQ(m.gps_glonass_mask, 0x33);
}

// Recordings of receivers.
TEST(NovatelAscii, InsPvaLongAndShort) {
  const auto [h, m] = only<InsPva>(
      "#INSPVAA,COM1,0,48.5,FINESTEERING,1702,47.848,00000000,ddae,7053;1702,221725.999755000,"
      "28.111270808,-80.624022245,-20.775880711,-63.661527253,39.651102732,-0.000502600,-0."
      "782552644,"
      "0.238876476,148.083596481,INS_SOLUTION_GOOD*b1967880");
  EXPECT_EQ(h.milliseconds, 47'848U);
  EXPECT_EQ(m.week, 1702U);
  EXPECT_EQ(m.seconds, 221725.999755);
  EXPECT_EQ(m.latitude_deg, 28.111270808);
  EXPECT_EQ(m.height_m, -20.775880711);
  EXPECT_EQ(m.north_mps, -63.661527253);
  EXPECT_EQ(m.east_mps, 39.651102732);
  EXPECT_EQ(m.up_mps, -0.0005026);
  EXPECT_EQ(m.roll_deg, -0.782552644);
  EXPECT_EQ(m.pitch_deg, 0.238876476);
  EXPECT_EQ(m.azimuth_deg, 148.083596481);
  EXPECT_EQ(m.ins_status, 3U);
  const auto [hs, s] = only<InsPvaS>(
      "%INSPVASA,2083,374524.200;2083,374524.200000000,31.51668826020,120.38636567293,13.9998,13."
      "1095,"
      "-12.9404,-0.0070,2.093819658,2.854168081,316.626703726,INS_SOLUTION_GOOD*8fc5adb1");
  EXPECT_TRUE(hs.short_form);
  EXPECT_EQ(hs.milliseconds, 374'524'200U);
  EXPECT_EQ(s.longitude_deg, 120.38636567293);
  EXPECT_EQ(s.azimuth_deg, 316.626703726);
}

TEST(NovatelAscii, InsPvaX) {
  const auto [h, m] = only<InsPvaX>(
      "#INSPVAXA,COM3,0,54.0,FINESTEERING,2060,199947.720,02008000,471d,14970;INS_SOLUTION_GOOD,"
      "INS_RTKFIXED,30.48279810362,114.16884102924,32.9221,-15.0000,-0.0016,-0.0011,0.0004,"
      "0.744013246,3.969861907,109.516743370,0.0226,0.0219,0.0277,0.0015,0.0015,0.0014,0.0277,0."
      "0270,"
      "0.1252,0f0000d7,0*49c32c60");
  EXPECT_EQ(h.port, 0x60);
  EXPECT_EQ(h.receiver_status, 0x02008000U);
  EXPECT_EQ(m.ins_status, 3U);
  EXPECT_EQ(m.position_type, 56U);
  EXPECT_EQ(m.height_m, 32.9221);
  EXPECT_EQ(m.undulation_m, -15.0F);
  EXPECT_EQ(m.up_mps, 0.0004);
  EXPECT_EQ(m.azimuth_deg, 109.51674337);
  EXPECT_EQ(m.latitude_sigma_m, 0.0226F);
  EXPECT_EQ(m.up_sigma_mps, 0.0014F);
  EXPECT_EQ(m.azimuth_sigma_deg, 0.1252F);
  EXPECT_EQ(m.extended_status, 0x0F0000D7U);
  EXPECT_EQ(m.since_update_s, 0);
}

// The manual's example; its receiver status is printed with another bit than the checksum covers.
TEST(NovatelAscii, InsAttX) {
  const auto [h, m] = only<InsAttX>(
      "#INSATTXA,COM1,0,81.0,FINESTEERING,1690,494542.000,00000040,5d25,43441;INS_ALIGNMENT_"
      "COMPLETE,"
      "INS_PSRSP,1.137798832,-0.163068414,135.754208544,0.017797431,0.017861038,3.168394804,4,0"
      "*f944b004");
  EXPECT_EQ(m.ins_status, 7U);
  EXPECT_EQ(m.roll_deg, 1.137798832);
  EXPECT_EQ(m.azimuth_deg, 135.754208544);
  EXPECT_EQ(m.azimuth_sigma_deg, 3.168394804F);
  EXPECT_EQ(m.extended_status, 4U);
}

template <class Message>
void expect_counts(const Message& m, const std::array<std::int32_t, 6>& counts) {
  EXPECT_EQ((std::array{m.z_accel, m.minus_y_accel, m.x_accel, m.z_gyro, m.minus_y_gyro, m.x_gyro}),
            counts);
}

// RAWIMU is a recording, the others are the manual's examples.
TEST(NovatelAscii, RawImuInAllItsForms) {
  const auto [h, raw] = only<RawImu>(
      "#RAWIMUA,COM3,0,72.0,FINESTEERING,2038,117867.800,1a008000,fa9a,14968;2038,117867.792005000,"
      "f7f7fe00,-325882330,-39071383,104462335,-240437176,7815616,-7423919*a02e612f");
  EXPECT_EQ(raw.seconds, 117867.792005);
  EXPECT_EQ(raw.imu_status, 0xF7F7FE00U);
  expect_counts(raw, {-325882330, -39071383, 104462335, -240437176, 7815616, -7423919});
  const auto [hs, s] = only<RawImuS>(
      "%RAWIMUSA,2209,491612.254;2209,491612.253588,ea5afe00,329303960,-2512321,4410363,309705,"
      "607017,"
      "-1009773*1fb76c28");
  EXPECT_EQ(hs.milliseconds, 491'612'254U);
  expect_counts(s, {329303960, -2512321, 4410363, 309705, 607017, -1009773});
  const auto [hx, x] = only<RawImuX>(
      "#RAWIMUXA,USB1,0,64.5,FINESTEERING,2209,491740.110,02000020,0dc5,16809;04,41,2209,"
      "491740.109817,ea57fe00,329394068,-2396829,4481425,321199,257329,-936077*cf9c035d");
  EXPECT_EQ(x.imu_info, 0x04);
  EXPECT_EQ(x.imu_type, 41);
  expect_counts(x, {329394068, -2396829, 4481425, 321199, 257329, -936077});
  const auto [hsx, sx] = only<RawImuSx>(
      "%RAWIMUSXA,2209,491674.014;04,41,2209,491674.013699,ea59fe00,329308016,-2706935,4508389,"
      "196192,"
      "417138,-1000837*038422a7");
  EXPECT_EQ(sx.seconds, 491674.013699);
  expect_counts(sx, {329308016, -2706935, 4508389, 196192, 417138, -1000837});
}

// NovAtel's own decoder is tested with these two: one log, binary and ASCII (novatel_edie, framer
// tests).
TEST(NovatelAscii, OneLogInBinaryAndInAsciiHasTheSameValues) {
  const std::vector<std::uint8_t> binary{
      0xAA, 0x44, 0x13, 0x28, 0xB6, 0x05, 0x9C, 0x06, 0x78, 0xB9, 0xE2, 0x1C, 0x00, 0x0B,
      0x9C, 0x06, 0x0B, 0x97, 0x55, 0xA8, 0x32, 0x94, 0x1D, 0x41, 0x03, 0x15, 0x80, 0x00,
      0xEB, 0xD0, 0x91, 0x02, 0xA6, 0x87, 0xF3, 0xFF, 0x38, 0xEA, 0xFC, 0xFF, 0x66, 0xB7,
      0xFC, 0xFF, 0x1C, 0x5F, 0xFF, 0xFF, 0x59, 0xD9, 0xFF, 0xFF, 0x47, 0x5F, 0xAF, 0xBA};
  const auto [h, ascii] = only<RawImuSx>(
      "%RAWIMUSXA,1692,484620.664;00,11,1692,484620.664389000,00801503,43110635,-817242,-202184,"
      "-215194,-41188,-9895*a5db8c7b");
  int frames = 0;
  NovatelStream stream;
  stream.feed(binary, [&, header = h, expected = ascii](const NovatelFrame& frame) {
    ++frames;
    EXPECT_EQ(frame.header, header);
    const auto decoded = decode(frame);
    ASSERT_TRUE(decoded.has_value());
    EXPECT_EQ(std::get<RawImuSx>(*decoded), expected);
  });
  EXPECT_EQ(frames, 1);
}

// CORRIMUDATAS is the manual's example, the others are recordings.
TEST(NovatelAscii, CorrectedImuInAllItsForms) {
  const auto [h, m] = only<CorrImuData>(
      "#CORRIMUDATAA,COM1,0,77.5,FINESTEERING,1769,237601.000,02000020,bdba,12597;1769,"
      "237601.000000000,-0.000003356,0.000002872,0.000001398,0.000151593,0.000038348,-0.000078820"
      "*e370e1d9");
  EXPECT_EQ(m.pitch_rad, -0.000003356);
  EXPECT_EQ(m.roll_rad, 0.000002872);
  EXPECT_EQ(m.yaw_rad, 0.000001398);
  EXPECT_EQ(m.lateral_mps, 0.000151593);
  EXPECT_EQ(m.longitudinal_mps, 0.000038348);
  EXPECT_EQ(m.vertical_mps, -0.00007882);
  const auto [hs, s] = only<CorrImuDataS>(
      "%CORRIMUDATASA,2209,488331.000;2209,488331.000000000,-0.0000016434879909,0.0000053888857361,"
      "-0.0000077180775912,-0.0001338946509402,-0.0013131748634920,-0.0002721905080061*bd5ba919");
  EXPECT_EQ(s.yaw_rad, -0.0000077180775912);
  EXPECT_EQ(s.longitudinal_mps, -0.001313174863492);
  const auto [hc, c] = only<CorrImuS>(
      "%CORRIMUSA,2269,129755.030;1,-0.0000731120567875,-0.0000083534662499,0.0000521803559345,"
      "-0.0007077320118335,0.0008881368174285,0.0001594393292871,7.090,0*b388322e");
  EXPECT_EQ(c.samples, 1U);
  EXPECT_EQ(c.pitch_rad, -0.0000731120567875);
  EXPECT_EQ(c.vertical_mps, 0.0001594393292871);
  EXPECT_EQ(c.reserved_1, 7.09F);
}

// The examples of the manual's pages.
TEST(NovatelAscii, InertialDeviations) {
  const auto [h, m] = only<InsStdDev>(
      "#INSSTDEVA,USB1,0,66.0,FINESTEERING,2209,491004.000,02000020,2396,16809;0.1813,0.1813,"
      "0.1806,0.0018,0.0018,0.0017,0.0292,0.0291,0.0577,13000045,0,0,7fd1bf,0*b490ddee");
  EXPECT_EQ(h.week, 2209);
  EXPECT_EQ(m.latitude_sigma_m, 0.1813F);
  EXPECT_EQ(m.height_sigma_m, 0.1806F);
  EXPECT_EQ(m.up_sigma_mps, 0.0017F);
  EXPECT_EQ(m.roll_sigma_deg, 0.0292F);
  EXPECT_EQ(m.azimuth_sigma_deg, 0.0577F);
  EXPECT_EQ(m.extended_status, 0x13000045U);
  EXPECT_EQ(m.reserved_2, 0x7fd1bfU);
}

TEST(NovatelAscii, InertialConfiguration) {
  const auto [h, m] = only<InsConfig>(
      "#INSCONFIGA,COM1,0,71.0,COARSESTEERING,1931,517331.006,02400000,6d7a,32768;EPSON_G320,6,50,"
      "20,DEFAULT,00ffd1bf,AUTOMATIC,ROVER,FALSE,00000000,0,0,0,0,0,0,0,0,0,1,ANT1,IMUBODY,0.0540,"
      "0.0699,-0.0346,0.0200,0.0200,0.0200,FROM_NVM,1,RBV,IMUBODY,180.0000,0.0000,90.0000,5.0000,"
      "5.0000,5.0000,FROM_COMMAND*b1233ac4");
  EXPECT_EQ(h.milliseconds, 517'331'006U);
  EXPECT_EQ(m.imu_type, 41U);
  EXPECT_EQ(m.mapping, 6);
  EXPECT_EQ(m.alignment_speed_dmps, 50);
  EXPECT_EQ(m.heave_window_s, 20);
  EXPECT_EQ(m.enabled_updates, 0x00ffd1bfU);
  EXPECT_EQ(m.alignment_mode, 3U);
  EXPECT_EQ(m.output_frame, 1U);
  ASSERT_EQ(m.translations, 1U);
  EXPECT_EQ(m.translation[0].kind, 1U);
  EXPECT_EQ(m.translation[0].y, 0.0699F);
  EXPECT_EQ(m.translation[0].source, 1U);
  ASSERT_EQ(m.rotations, 1U);
  EXPECT_EQ(m.rotation[0].kind, 11U);
  EXPECT_EQ(m.rotation[0].x, 180.0F);
  EXPECT_EQ(m.rotation[0].z_sigma, 5.0F);
  EXPECT_EQ(m.rotation[0].source, 4U);
}

// TIME and BESTUTM are recordings; RXSTATUS has the values of the manual's example, whose form is
// abbreviated, and a checksum by zlib.
TEST(NovatelAscii, TimeStatusAndUtm) {
  const auto [ht, t] = only<Time>(
      "#TIMEA,COM1,0,86.5,FINESTEERING,1930,428348.000,02000020,9924,32768;VALID,1.667187222e-10,"
      "9.641617960e-10,-18.00000000000,2017,1,5,22,58,50000,VALID*2a066e78");
  EXPECT_EQ(t.clock_status, 0U);
  EXPECT_EQ(t.offset_s, 1.667187222e-10);
  EXPECT_EQ(t.offset_sigma_s, 9.64161796e-10);
  EXPECT_EQ(t.utc_offset_s, -18.0);
  EXPECT_EQ(t.utc_year, 2017U);
  EXPECT_EQ((std::array{t.utc_month, t.utc_day, t.utc_hour, t.utc_minute}),
            (std::array<std::uint8_t, 4>{1, 5, 22, 58}));
  EXPECT_EQ(t.utc_ms, 50'000U);
  EXPECT_EQ(t.utc_status, 1U);
  const auto [hu, u] = only<BestUtm>(
      "#BESTUTMA,COM3,0,25.5,FINESTEERING,1638,515217.200,00000000,eb16,6302;SOL_COMPUTED,OMNISTAR_"
      "HP,"
      "17,T,4727502.1668,320079.3993,284.4611,-35.0000,WGS84,0.0984,0.4398,0.1960,\"1001\",4.000,0."
      "000,"
      "15,8,8,8,0,00,0,03*11855669");
  EXPECT_EQ(u.position_type, 64U);
  EXPECT_EQ(u.zone_number, 17U);
  EXPECT_EQ(u.zone_letter, static_cast<std::uint32_t>('T'));
  EXPECT_EQ(u.northing_m, 4727502.1668);
  EXPECT_EQ(u.easting_m, 320079.3993);
  EXPECT_EQ(u.northing_sigma_m, 0.0984F);
  EXPECT_EQ(u.differential_age_s, 4.0F);
  const auto [hr, r] = only<RxStatus>(
      "#RXSTATUSA,COM1,0,90.5,FINESTEERING,1740,232531.278,02000020,2ae1,44913;00000000,4,02000020,"
      "00000000,00000000,00000000,00040080,00001008,00000000,00000000,00000000,00000000,00000000,"
      "00000000,02000000,00000000,00000000,00000000*8d6306de");
  EXPECT_EQ(r.error, 0U);
  EXPECT_EQ(r.words, 4U);
  EXPECT_EQ(r.receiver.bits, 0x02000020U);
  EXPECT_EQ(r.auxiliary_1.bits, 0x00040080U);
  EXPECT_EQ(r.auxiliary_1.priority_mask, 0x00001008U);
  EXPECT_EQ(r.auxiliary_3.bits, 0x02000000U);
}

std::string with_crc(const std::string& between) {
  std::array<char, 9> crc{};
  std::snprintf(crc.data(), crc.size(), "%08x", bits::crc32_novatel(as_bytes(between)));
  return "#" + between + "*" + crc.data() + "\r\n";
}

constexpr const char* kHeader =
    "BESTVELA,COM1,0,73.5,FINESTEERING,2076,112838.000,00000000,000e,1;";

TEST(NovatelAscii, WhatCannotBeReadIsRefusedWithItsReason) {
  const auto refusal = [](const std::string& fields) {
    const auto received = sentences_of(with_crc(kHeader + fields));
    EXPECT_EQ(received.size(), 1U) << fields;
    return received.empty() ? std::nullopt : received[0].refusal;
  };
  EXPECT_EQ(refusal("SOL_COMPUTED,SINGLE,0,1,2.5,90,0.5,0"), std::nullopt);
  EXPECT_EQ(refusal("SOL_COMPUTED,SINGLE,0,1,2.5,90,0.5,0,new,fields"), std::nullopt);
  EXPECT_EQ(refusal("0,16,0,1,2.5,90,0.5,0"), std::nullopt);  // numbers for names
  EXPECT_EQ(refusal("SOL_COMPUTED,SINGLE,0,1,2.5,90,0.5"), DecodeError::kTooShort);
  EXPECT_EQ(refusal(""), DecodeError::kBadText);
  for (const char* bad : {"COMPUTED", "", " ", "-1", "0x1", "4294967296"}) {
    EXPECT_EQ(refusal(std::string{bad} + ",SINGLE,0,1,2.5,90,0.5,0"), DecodeError::kBadText) << bad;
  }
  for (const char* bad : {"", "2.5 ", " 2.5", "x", "--2", "+2", "1e999"}) {
    EXPECT_EQ(refusal("SOL_COMPUTED,SINGLE,0,1," + std::string{bad} + ",90,0.5,0"),
              DecodeError::kBadText)
        << bad;
  }
  EXPECT_EQ(refusal("SOL_COMPUTED,SINGLE,0,1,nan,90,0.5,0"), DecodeError::kNotFinite);
}

TEST(NovatelAscii, AHeaderThatIsNoneIsNoLog) {
  const std::string fields = "SOL_COMPUTED,SINGLE,0,1,2.5,90,0.5,0";
  EXPECT_EQ(sentences_of(with_crc(kHeader + fields)).size(), 1U);
  for (const char* header : {"BESTVELA,COM1,0,73.5,FINESTEERING,2076,112838.000,00000000,000e;",
                             "BESTVELA,COM1,0,73.5,FINESTEERING,2076,112838.000,00000000,000e,1,2;",
                             "BESTVEL,COM1,0,73.5,FINESTEERING,2076,112838.000,00000000,000e,1;",
                             "BESTVELA,COM1,0,173.5,FINESTEERING,2076,112838.000,00000000,000e,1;",
                             "BESTVELA,COM1,0,73.5,FINE_STEERING,2076,112838.000,00000000,000e,1;",
                             "BESTVELA,COM1,0,73.5,FINESTEERING,20760,612838.000,00000000,000e,1;",
                             "BESTVELA,2076,112838.000;", "A;", "BESTVELA"}) {
    EXPECT_TRUE(sentences_of(with_crc(header + fields)).empty()) << header;
  }
}

TEST(NovatelAscii, ResponsesAndLogsThatWeDoNotKnow) {
  const std::string rest = ",COM1,0,73.5,FINESTEERING,2076,112838.000,00000000,000e,1;OK";
  EXPECT_EQ(sentences_of(with_crc("BESTVELR" + rest))[0].refusal, DecodeError::kResponse);
  EXPECT_EQ(sentences_of(with_crc("PSRDOP2A" + rest))[0].refusal, DecodeError::kUnknownId);
}

TEST(NovatelAscii, WhatIsWrittenReadsBackTheSame) {
  std::mt19937_64 random{11};
  std::array<std::uint8_t, kMaxAsciiBytes> out{};
  for (int i = 0; i < 4'000; ++i) {
    const NovatelMessage message = random_message(static_cast<std::size_t>(i) % kLogs, random);
    const NovatelHeader header = random_header(random);
    const std::size_t n = encode_ascii(header, message, out);
    const auto received = sentences_of({out.begin(), out.begin() + static_cast<std::ptrdiff_t>(n)});
    ASSERT_EQ(received.size(), 1U) << i;
    EXPECT_EQ(received[0].header, as_sent(header, message)) << i;
    ASSERT_TRUE(received[0].message) << text(*received[0].refusal);
    EXPECT_TRUE(*received[0].message == message) << i;
  }
}

}  // namespace
}  // namespace pitwall::gnss
