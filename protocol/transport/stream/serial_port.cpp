// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/serial_port.hpp"

#include <fcntl.h>
#include <termios.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace pitwall::transport {
namespace {

struct Rate {
  int baud;
  speed_t speed;
};

constexpr std::array kRates{
    Rate{4'800, B4800},        Rate{9'600, B9600},        Rate{19'200, B19200},
    Rate{38'400, B38400},      Rate{57'600, B57600},      Rate{115'200, B115200},
    Rate{230'400, B230400},    Rate{460'800, B460800},    Rate{500'000, B500000},
    Rate{921'600, B921600},    Rate{1'000'000, B1000000}, Rate{1'500'000, B1500000},
    Rate{2'000'000, B2000000}, Rate{3'000'000, B3000000}, Rate{4'000'000, B4000000}};

const Rate* rate_of(int baud) {
  const auto* rate = std::ranges::find(kRates, baud, &Rate::baud);
  return rate == kRates.end() ? nullptr : rate;
}

std::string no_such_rate(int baud) {
  return "serial devices of Linux do not have the rate " + std::to_string(baud);
}

PosixOutcome set_raw(int tty, const Rate* rate) {
  termios settings{};
  const auto got = posix_call([&] { return tcgetattr(tty, &settings); });
  if (!got.ok()) return got;
  cfmakeraw(&settings);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cc[VMIN] = 1;
  settings.c_cc[VTIME] = 0;
  if (rate != nullptr) {
    settings.c_cflag &= ~static_cast<tcflag_t>(CRTSCTS | CSTOPB);
    cfsetispeed(&settings, rate->speed);
    cfsetospeed(&settings, rate->speed);
  }
  return posix_call([&] { return tcsetattr(tty, TCSANOW, &settings); });
}

}  // namespace

Result<SerialDevice, Problem> parse_serial_device(std::string_view text) {
  const std::size_t colon = text.rfind(':');
  SerialDevice device{.path = std::string(text.substr(0, colon))};
  if (!device.path.starts_with('/'))
    return refuse(text, "expected the path of a device, as /dev/ttyS0");
  if (colon == std::string_view::npos) return device;
  const std::string_view rate = text.substr(colon + 1);
  const auto [end, error] = std::from_chars(rate.data(), rate.data() + rate.size(), device.baud);
  if (error != std::errc{} || end != rate.data() + rate.size())
    return refuse(text, "\"" + std::string(rate) + "\" is not a baud rate");
  if (rate_of(device.baud) == nullptr) return refuse(text, no_such_rate(device.baud));
  return device;
}

PosixOutcome make_raw(int tty) { return set_raw(tty, nullptr); }

Result<FileDescriptor, Problem> open_serial(const std::string& path, int baud) {
  const Rate* rate = rate_of(baud);
  if (rate == nullptr) return refuse(path, no_such_rate(baud));
  const auto opened =
      posix_call([&] { return ::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC); });
  FileDescriptor fd(opened);
  if (!fd.valid()) return Unexpected{Problem{path, opened.reason()}};
  const auto raw = set_raw(fd.get(), rate);
  if (!raw.ok()) return Unexpected{Problem{path, "is not a serial device: " + raw.reason()}};
  static_cast<void>(posix_call([&] { return tcflush(fd.get(), TCIFLUSH); }));  // of another rate
  return fd;
}

}  // namespace pitwall::transport
