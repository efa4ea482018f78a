// SPDX-License-Identifier: Apache-2.0
#include "protocol/gnss/novatel_names.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

namespace pitwall::gnss {
namespace {

struct Named {
  std::uint32_t value;
  std::string_view name;
};

constexpr std::array kLogs{
    Named{42, "BESTPOS"},
    Named{93, "RXSTATUS"},
    Named{99, "BESTVEL"},
    Named{101, "TIME"},
    Named{268, "RAWIMU"},
    Named{325, "RAWIMUS"},
    Named{507, "INSPVA"},
    Named{508, "INSPVAS"},
    Named{726, "BESTUTM"},
    Named{812, "CORRIMUDATA"},
    Named{813, "CORRIMUDATAS"},
    Named{1335, "HEADING2"},
    Named{1362, "IMURATECORRIMUS"},
    Named{1457, "INSATTX"},
    Named{1461, "RAWIMUX"},
    Named{1462, "RAWIMUSX"},
    Named{1465, "INSPVAX"},
    Named{1945, "INSCONFIG"},
    Named{2042, "DUALANTENNAHEADING"},
    Named{2051, "INSSTDEV"},
    Named{2052, "INSSTDEVS"},
    Named{2264, "CORRIMUS"},
};

constexpr std::array kSolution{
    Named{0, "SOL_COMPUTED"}, Named{1, "INSUFFICIENT_OBS"},   Named{2, "NO_CONVERGENCE"},
    Named{3, "SINGULARITY"},  Named{4, "COV_TRACE"},          Named{5, "TEST_DIST"},
    Named{6, "COLD_START"},   Named{7, "V_H_LIMIT"},          Named{8, "VARIANCE"},
    Named{9, "RESIDUALS"},    Named{13, "INTEGRITY_WARNING"}, Named{18, "PENDING"},
    Named{19, "INVALID_FIX"}, Named{20, "UNAUTHORIZED"},      Named{22, "INVALID_RATE"},
};

constexpr std::array kPosition{
    Named{0, "NONE"},
    Named{1, "FIXEDPOS"},
    Named{2, "FIXEDHEIGHT"},
    Named{8, "DOPPLER_VELOCITY"},
    Named{16, "SINGLE"},
    Named{17, "PSRDIFF"},
    Named{18, "WAAS"},
    Named{19, "PROPAGATED"},
    Named{20, "OMNISTAR"},
    Named{32, "L1_FLOAT"},
    Named{33, "IONOFREE_FLOAT"},
    Named{34, "NARROW_FLOAT"},
    Named{48, "L1_INT"},
    Named{49, "WIDE_INT"},
    Named{50, "NARROW_INT"},
    Named{51, "RTK_DIRECT_INS"},
    Named{52, "INS_SBAS"},
    Named{53, "INS_PSRSP"},
    Named{54, "INS_PSRDIFF"},
    Named{55, "INS_RTKFLOAT"},
    Named{56, "INS_RTKFIXED"},
    Named{64, "OMNISTAR_HP"},
    Named{65, "OMNISTAR_XP"},
    Named{68, "PPP_CONVERGING"},
    Named{69, "PPP"},
    Named{70, "OPERATIONAL"},
    Named{71, "WARNING"},
    Named{72, "OUT_OF_BOUNDS"},
    Named{73, "INS_PPP_CONVERGING"},
    Named{74, "INS_PPP"},
    Named{77, "PPP_BASIC_CONVERGING"},
    Named{78, "PPP_BASIC"},
    Named{79, "INS_PPP_BASIC_CONVERGING"},
    Named{80, "INS_PPP_BASIC"},
};

constexpr std::array kInsStatus{
    Named{0, "INS_INACTIVE"},
    Named{1, "INS_ALIGNING"},
    Named{2, "INS_HIGH_VARIANCE"},
    Named{3, "INS_SOLUTION_GOOD"},
    Named{6, "INS_SOLUTION_FREE"},
    Named{7, "INS_ALIGNMENT_COMPLETE"},
    Named{8, "DETERMINING_ORIENTATION"},
    Named{9, "WAITING_INITIALPOS"},
    Named{10, "WAITING_AZIMUTH"},
    Named{11, "INITIALIZING_BIASES"},
    Named{12, "MOTION_DETECT"},
    Named{14, "WAITING_ALIGNMENTORIENTATION"},
};

constexpr std::array kDatum{Named{61, "WGS84"}, Named{63, "USER"}};
constexpr std::array kClock{Named{0, "VALID"}, Named{1, "CONVERGING"}, Named{2, "ITERATING"},
                            Named{3, "INVALID"}};
constexpr std::array kUtc{Named{0, "INVALID"}, Named{1, "VALID"}, Named{2, "WARNING"}};

// The IMUs whose scale we know (imu_scale.hpp).
constexpr std::array kImuType{Named{0, "UNKNOWN"}, Named{41, "EPSON_G320"}, Named{61, "EPSON_G370"},
                              Named{62, "EPSON_G320_200HZ"}};
constexpr std::array kProfile{
    Named{0, "DEFAULT"}, Named{1, "LAND"}, Named{2, "MARINE"}, Named{3, "FIXEDWING"},
    Named{4, "FOOT"},    Named{5, "VTOL"}, Named{6, "RAIL"},
};
constexpr std::array kAlignment{Named{0, "UNAIDED"}, Named{2, "AIDED_TRANSFER"},
                                Named{3, "AUTOMATIC"}, Named{4, "STATIC"}, Named{5, "KINEMATIC"}};
constexpr std::array kOutputFrame{Named{1, "ROVER"}, Named{2, "MASTER"}, Named{3, "ECEF"},
                                  Named{4, "LOCALLEVEL"}};
constexpr std::array kOffsetFrame{Named{0, "IMUBODY"}, Named{1, "VEHICLE"}};
constexpr std::array kOffset{
    Named{1, "ANT1"},  Named{2, "ANT2"},   Named{3, "EXTERNAL"}, Named{4, "USER"},
    Named{5, "MARK1"}, Named{6, "MARK2"},  Named{7, "GIMBAL"},   Named{8, "ALIGN"},
    Named{9, "MARK3"}, Named{10, "MARK4"}, Named{11, "RBV"},     Named{12, "RBM"},
};
constexpr std::array kOffsetSource{
    Named{1, "FROM_NVM"},       Named{2, "CALIBRATING"},
    Named{3, "CALIBRATED"},     Named{4, "FROM_COMMAND"},
    Named{5, "RESET"},          Named{6, "FROM_DUAL_ANT"},
    Named{7, "INS_CONVERGING"}, Named{8, "INSUFFICIENT_SPEED"},
    Named{9, "HIGH_ROTATION"},
};
constexpr std::array kTruth{Named{0, "FALSE"}, Named{1, "TRUE"}};

constexpr std::array kTimeStatus{
    Named{20, "UNKNOWN"},        Named{60, "APPROXIMATE"},     Named{80, "COARSEADJUSTING"},
    Named{100, "COARSE"},        Named{120, "COARSESTEERING"}, Named{130, "FREEWHEELING"},
    Named{140, "FINEADJUSTING"}, Named{160, "FINE"},           Named{170, "FINEBACKUPSTEERING"},
    Named{180, "FINESTEERING"},  Named{200, "SATTIME"},
};

// The first of the 32 virtual ports of each.
constexpr unsigned kVirtualPorts = 32;
constexpr std::array kPorts{Named{0x20, "COM1"},    Named{0x40, "COM2"},     Named{0x60, "COM3"},
                            Named{0xA0, "SPECIAL"}, Named{0xC0, "THISPORT"}, Named{0xE0, "FILE"}};

std::span<const Named> table(Kind kind) {
  switch (kind) {
    case Kind::kSolution:
      return kSolution;
    case Kind::kPosition:
      return kPosition;
    case Kind::kInsStatus:
      return kInsStatus;
    case Kind::kDatum:
      return kDatum;
    case Kind::kClock:
      return kClock;
    case Kind::kUtc:
      return kUtc;
    case Kind::kImuType:
      return kImuType;
    case Kind::kProfile:
      return kProfile;
    case Kind::kAlignment:
      return kAlignment;
    case Kind::kOutputFrame:
      return kOutputFrame;
    case Kind::kOffsetFrame:
      return kOffsetFrame;
    case Kind::kOffset:
      return kOffset;
    case Kind::kOffsetSource:
      return kOffsetSource;
    case Kind::kTruth:
      return kTruth;
    default:
      return {};
  }
}

std::string_view name_in(std::span<const Named> names, std::uint32_t value) {
  const auto found = std::find_if(names.begin(), names.end(),
                                  [value](const Named& n) { return n.value == value; });
  return found == names.end() ? std::string_view{} : found->name;
}

std::optional<std::uint32_t> value_in(std::span<const Named> names, std::string_view name) {
  const auto found =
      std::find_if(names.begin(), names.end(), [name](const Named& n) { return n.name == name; });
  if (found == names.end()) return std::nullopt;
  return found->value;
}

}  // namespace

std::string_view name_of(Kind kind, std::uint32_t value) { return name_in(table(kind), value); }

std::optional<std::uint32_t> value_of(Kind kind, std::string_view name) {
  return value_in(table(kind), name);
}

std::string_view log_name(std::uint16_t id) { return name_in(kLogs, id); }

std::optional<std::uint16_t> log_id(std::string_view name) {
  const auto id = value_in(kLogs, name);
  if (!id) return std::nullopt;
  return static_cast<std::uint16_t>(*id);
}

std::string_view time_status_name(std::uint8_t status) { return name_in(kTimeStatus, status); }

std::optional<std::uint8_t> time_status_value(std::string_view name) {
  const auto status = value_in(kTimeStatus, name);
  if (!status) return std::nullopt;
  return static_cast<std::uint8_t>(*status);
}

std::optional<PortName> port_name(std::uint8_t port) {
  const std::string_view name = name_in(kPorts, port - port % kVirtualPorts);
  if (name.empty()) return std::nullopt;
  return PortName{name, port % kVirtualPorts};
}

std::optional<std::uint8_t> port_value(std::string_view name) {
  const std::size_t underscore = name.find('_');
  const auto first = value_in(kPorts, name.substr(0, underscore));
  if (!first) return std::nullopt;
  unsigned number = 0;
  if (underscore != std::string_view::npos) {
    const std::string_view digits = name.substr(underscore + 1);
    const auto end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    if (error != std::errc{} || stop != end || number >= kVirtualPorts) return std::nullopt;
  }
  return static_cast<std::uint8_t>(*first + number);
}

}  // namespace pitwall::gnss
