// With a stand-in for the hub's program; the real one is in tests/system/unix_bus.
// SPDX-License-Identifier: Apache-2.0
#include "hil/can_bus/own_hub.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "protocol/transport/file.hpp"
#include "tests/support/unix_bus_bench.hpp"

namespace pitwall::can_bus {
namespace {

class OwnHubOnBench : public testing::UnixBusBench {
 protected:
  // A program that is called as the hub is: "bus" "hub" NAME.
  std::string program(const std::string& body) {
    const std::string path = folder_->path() + "/program";
    EXPECT_TRUE(transport::write_file(path, "#!/usr/bin/python3\n" + body));
    EXPECT_EQ(chmod(path.c_str(), 0755), 0);
    return path;
  }
};

TEST_F(OwnHubOnBench, IsNotStartedWhereNoneIsNeeded) {
  for (const std::string& bus : {std::string("vcan0"), bus_}) {
    const auto own = OwnHub::start("/no/such/program", bus);
    ASSERT_TRUE(own) << to_string(own.error());
    EXPECT_FALSE(own->has_value());
  }
}

TEST_F(OwnHubOnBench, OneThatDoesNotStartIsAProblemOfTheBus) {
  hub_.reset();
  for (const std::string& bad :
       {std::string("/no/such/program"), program("raise SystemExit(2)\n")}) {
    const auto own = OwnHub::start(bad, bus_);
    EXPECT_FALSE(own);
  }
  const auto own = OwnHub::start("/bin/true", "unix:");
  ASSERT_FALSE(own);
  EXPECT_EQ(own.error().place, "unix:");
}

TEST_F(OwnHubOnBench, TakesClientsWhenItIsThereAndIsAskedToEndWithItsOwner) {
  hub_.reset();
  const std::string hub = program(R"(
import signal, socket, sys
assert sys.argv[1:3] == ["bus", "hub"]
path = sys.argv[3].removeprefix("unix:")
listener = socket.socket(socket.AF_UNIX, socket.SOCK_SEQPACKET)
listener.bind(path)
def end(*_):
    open(path + ".ended", "w").close()
    sys.exit(0)
signal.signal(signal.SIGTERM, end)
listener.listen(64)
while True:
    signal.pause()
)");
  {
    auto own = OwnHub::start(hub, bus_);
    ASSERT_TRUE(own) << to_string(own.error());
    ASSERT_TRUE(own->has_value());
    const OwnHub moved = std::move(**own);
    const auto address = transport::unix_bus_address(bus_);
    EXPECT_TRUE(transport::hub_serves(*address));
    EXPECT_FALSE(transport::read_file(path() + ".ended"));
  }
  EXPECT_TRUE(transport::read_file(path() + ".ended"));
}

}  // namespace
}  // namespace pitwall::can_bus
