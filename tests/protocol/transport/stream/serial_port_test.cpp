// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/stream/serial_port.hpp"

#include <gtest/gtest.h>
#include <termios.h>

#include "tests/support/pty.hpp"

namespace pitwall::transport {
namespace {

using support::Pty;

TEST(SerialPort, HasTheRateThatWasAskedForAndNoManners) {
  const Pty pty;
  const auto port = open_serial(pty.path(), 921'600);
  ASSERT_TRUE(port) << to_string(port.error());
  termios settings{};
  ASSERT_EQ(tcgetattr(port->get(), &settings), 0);
  EXPECT_EQ(cfgetispeed(&settings), static_cast<speed_t>(B921600));
  EXPECT_EQ(settings.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
  EXPECT_EQ(settings.c_cflag & (PARENB | CSTOPB | CRTSCTS), 0U);
  EXPECT_EQ(settings.c_lflag & (ICANON | ECHO | ISIG), 0U);
  EXPECT_EQ(settings.c_iflag & (IXON | IXOFF | ICRNL | ISTRIP), 0U);
}

TEST(SerialDevice, IsReadFromItsText) {
  EXPECT_EQ(parse_serial_device("/dev/ttyS0").value_or({}),
            (SerialDevice{"/dev/ttyS0", kReceiverBaud}));
  EXPECT_EQ(parse_serial_device("/dev/ttyS0:9600").value_or({}),
            (SerialDevice{"/dev/ttyS0", 9'600}));
  for (const char* text : {"", "ttyS0", "ttyS0:9600", "/dev/ttyS0:", "/dev/ttyS0:fast",
                           "/dev/ttyS0:9600x", "/dev/ttyS0:12345", "/dev/ttyS0:99999999999"}) {
    const auto refused = parse_serial_device(text);
    ASSERT_FALSE(refused) << text;
    EXPECT_EQ(refused.error().place, text);
  }
}

TEST(SerialPort, NamesWhatIsWrong) {
  const Pty pty;
  const auto odd = open_serial(pty.path(), 12'345);
  ASSERT_FALSE(odd);
  EXPECT_NE(to_string(odd.error()).find("12345"), std::string::npos);
  const auto missing = open_serial("/dev/no_such_tty", 115'200);
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().place, "/dev/no_such_tty");
  const auto no_tty = open_serial("/dev/null", 115'200);
  ASSERT_FALSE(no_tty);
  EXPECT_NE(no_tty.error().what.find("not a serial device"), std::string::npos);
}

}  // namespace
}  // namespace pitwall::transport
