// SPDX-License-Identifier: Apache-2.0
#include "protocol/transport/can/can_interface.hpp"

#include <linux/can/netlink.h>
#include <linux/pkt_sched.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>

#include <utility>

#include "protocol/transport/clock.hpp"

namespace pitwall::transport {
namespace {

constexpr std::size_t kAnswerBytes = 32 * 1024;  // the kernel's own limit for one message
constexpr std::string_view kCanKind = "can";
constexpr std::string_view kNoController = "has no CAN controller";
constexpr std::string_view kPlainQueue = "pfifo_fast";

BusState state_of(std::uint32_t kernel_state) {
  switch (kernel_state) {
    case CAN_STATE_ERROR_ACTIVE:
      return BusState::kActive;
    case CAN_STATE_ERROR_WARNING:
      return BusState::kWarning;
    case CAN_STATE_ERROR_PASSIVE:
      return BusState::kPassive;
    case CAN_STATE_BUS_OFF:
      return BusState::kBusOff;
    default:
      return BusState::kUnknown;
  }
}

void read_controller(NetlinkBytes data, CanInterfaceStatus& out) {
  for_each_attribute(data, [&](unsigned attribute, NetlinkBytes value) {
    switch (attribute) {
      case IFLA_CAN_STATE:
        out.state = state_of(read_as<std::uint32_t>(value));
        break;
      case IFLA_CAN_BITTIMING:
        out.bitrate = read_as<can_bittiming>(value).bitrate;
        break;
      case IFLA_CAN_RESTART_MS:
        out.restart_ms = read_as<std::uint32_t>(value);
        break;
      case IFLA_CAN_CTRLMODE:
        out.listen_only = (read_as<can_ctrlmode>(value).flags & CAN_CTRLMODE_LISTENONLY) != 0U;
        break;
      case IFLA_CAN_BERR_COUNTER:
        out.errors_known = true;
        out.tx_errors = read_as<can_berr_counter>(value).txerr;
        out.rx_errors = read_as<can_berr_counter>(value).rxerr;
        break;
      default:
        break;
    }
  });
}

void read_link_info(NetlinkBytes info, CanInterfaceStatus& out) {
  for_each_attribute(info, [&](unsigned attribute, NetlinkBytes value) {
    if (attribute == IFLA_INFO_KIND) out.has_controller = read_text(value) == kCanKind;
    if (!out.has_controller) return;  // the kind comes first
    if (attribute == IFLA_INFO_DATA) read_controller(value, out);
    if (attribute != IFLA_INFO_XSTATS) return;
    const auto counted = read_as<can_device_stats>(value);
    out.bus_errors = counted.bus_error;
    out.warnings = counted.error_warning;
    out.passives = counted.error_passive;
    out.bus_offs = counted.bus_off;
    out.restarts = counted.restarts;
  });
}

void read_statistics(NetlinkBytes value, CanInterfaceStatus& out) {
  const auto counted = read_as<rtnl_link_stats64>(value);
  out.rx_packets = counted.rx_packets;
  out.tx_packets = counted.tx_packets;
  out.rx_dropped = counted.rx_dropped;
  out.rx_over_errors = counted.rx_over_errors;
  out.tx_dropped = counted.tx_dropped;
}

ifinfomsg link_of(int index) {
  ifinfomsg link{};
  link.ifi_family = AF_UNSPEC;
  link.ifi_index = index;
  return link;
}

// Fills the attributes of the controller between kind and end.
template <class Fill>
void put_controller(NetlinkRequest& request, Fill&& fill) {
  const std::size_t info = request.open_nest(IFLA_LINKINFO);
  request.put_text(IFLA_INFO_KIND, kCanKind);
  const std::size_t data = request.open_nest(IFLA_INFO_DATA);
  fill();
  request.close_nest(data);
  request.close_nest(info);
}

std::string words_of(NetlinkBytes error_message) {
  std::string out;
  for_each_attribute(attributes_after<nlmsgerr>(error_message),
                     [&](unsigned attribute, NetlinkBytes value) {
                       if (attribute == NLMSGERR_ATTR_MSG) out = read_text(value);
                     });
  return out;
}

}  // namespace

CanInterfaceStatus read_link(NetlinkBytes message) {
  CanInterfaceStatus out;
  const auto link = read_as<ifinfomsg>(message);
  out.exists = true;
  out.up = (link.ifi_flags & IFF_UP) != 0U;
  for_each_attribute(attributes_after<ifinfomsg>(message),
                     [&](unsigned attribute, NetlinkBytes value) {
                       // At once, where the flag IFF_RUNNING comes up to a second late.
                       if (attribute == IFLA_CARRIER)
                         out.running = out.up && read_as<std::uint8_t>(value) != 0;
                       if (attribute == IFLA_LINKINFO) read_link_info(value, out);
                       if (attribute == IFLA_STATS64) read_statistics(value, out);
                       if (attribute == IFLA_TXQLEN)
                         out.tx_queue_frames = read_as<std::uint32_t>(value);
                       if (attribute == IFLA_QDISC)
                         out.plain_queue = read_text(value) == kPlainQueue;
                     });
  return out;
}

CanInterface::CanInterface(std::string name, FileDescriptor socket)
    : name_(std::move(name)), socket_(std::move(socket)), buffer_(kAnswerBytes) {}

Result<CanInterface, Problem> CanInterface::open(std::string_view interface) {
  if (is_unix_bus(interface)) return open_unix(interface);
  const std::string name(interface);
  if (name.empty() || name.size() >= IFNAMSIZ)
    return Unexpected{Problem{name, "not an interface name"}};
  const unsigned index = if_nametoindex(name.c_str());
  if (index == 0) return Unexpected{Problem{name, "no such interface"}};
  CanInterface out(name, FileDescriptor(posix_call([] {
                     return socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
                   })));
  out.index_ = static_cast<int>(index);
  const int on = 1;  // both only make refusals clearer: a kernel without them is no obstacle
  for (const int option : {NETLINK_EXT_ACK, NETLINK_CAP_ACK})
    static_cast<void>(posix_call(
        [&] { return setsockopt(out.socket_.get(), SOL_NETLINK, option, &on, sizeof on); }));
  if (!out.socket_.valid() || !out.refresh())
    return Unexpected{out.problem("cannot ask the kernel about interfaces")};
  return out;
}

Result<CanInterface, Problem> CanInterface::open_unix(std::string_view interface) {
  const auto address = unix_bus_address(interface);
  if (!address) return Unexpected{address.error()};
  CanInterface out{std::string(interface), FileDescriptor{}};
  out.hub_ = *address;
  const auto connected = connect_to_hub(*address, ReceiveMode::kNothing, out.socket_);
  if (!connected.ok()) return Unexpected{hub_problem(interface, connected)};
  out.refresh();
  return out;
}

void CanInterface::look_at_hub() {
  if (!hub_is_there(socket_.get())) {
    socket_.reset();
    static_cast<void>(connect_to_hub(*hub_, ReceiveMode::kNothing, socket_));
  }
  status_ = {.exists = true, .up = socket_.valid(), .running = socket_.valid()};
}

// The kernel answers while it takes the request, so the answer is there when send() returns.
PosixOutcome CanInterface::ask(NetlinkRequest& request, NetlinkBytes& answer) {
  const std::uint32_t sequence = ++sequence_;
  const NetlinkBytes bytes = request.bytes(sequence);
  const auto sent = posix_call([&] { return send(socket_.get(), bytes.data(), bytes.size(), 0); });
  if (!sent.ok()) return sent;
  while (true) {
    const auto got = posix_call(
        [&] { return recv(socket_.get(), buffer_.data(), buffer_.size(), MSG_DONTWAIT); });
    if (!got.ok()) return got;
    const NetlinkBytes all(buffer_.data(), static_cast<std::size_t>(got.value));
    const auto head = read_as<nlmsghdr>(all);
    if (head.nlmsg_seq != sequence) continue;  // the answer to a request that failed before
    if (head.nlmsg_len < sizeof head || head.nlmsg_len > all.size())
      return {.value = -1, .error = EBADMSG};
    answer = all.subspan(sizeof head, head.nlmsg_len - sizeof head);
    if (head.nlmsg_type != NLMSG_ERROR) return {.value = 0, .error = 0};
    const int error = -read_as<nlmsgerr>(answer).error;
    return {.value = error == 0 ? 0 : -1, .error = error};
  }
}

bool CanInterface::refresh() {
  const Instant asked = monotonic_now();
  if (hub_) {
    look_at_hub();
    status_.at = asked;
    return true;
  }
  NetlinkRequest request(RTM_GETLINK, 0, link_of(index_));
  NetlinkBytes answer;
  const auto outcome = ask(request, answer);
  if (outcome.error == ENODEV) {
    status_ = {};
  } else if (outcome.ok()) {
    status_ = read_link(answer);
  } else {
    ++failures_;
    return false;
  }
  status_.at = asked;
  return true;
}

std::optional<Problem> CanInterface::change(NetlinkRequest request, std::string_view what,
                                            int* error) {
  NetlinkBytes answer;
  const auto outcome = ask(request, answer);
  if (error != nullptr) *error = outcome.error;
  if (outcome.ok()) return std::nullopt;
  std::string why = outcome.reason();
  if (const std::string words = words_of(answer); !words.empty()) why += " (" + words + ")";
  if (outcome.error == EPERM) why += ": needs root (CAP_NET_ADMIN)";
  return problem(std::string(what) + ": " + why);
}

std::optional<Problem> CanInterface::set_up(bool up) {
  ifinfomsg link = link_of(index_);
  link.ifi_change = IFF_UP;
  link.ifi_flags = up ? static_cast<unsigned>(IFF_UP) : 0U;
  return change(NetlinkRequest(RTM_NEWLINK, NLM_F_ACK, link),
                up ? "cannot be set up" : "cannot be taken down");
}

std::optional<Problem> CanInterface::configure(const CanInterfaceSettings& settings) {
  if (!status_.has_controller) return problem(std::string(kNoController));
  if (auto failed = set_up(false)) return failed;
  if (settings.tx_queue_frames) {
    NetlinkRequest request(RTM_NEWLINK, NLM_F_ACK, link_of(index_));
    request.put(IFLA_TXQLEN, *settings.tx_queue_frames);
    if (auto failed = change(request, "queue length refused")) return failed;
  }
  const auto set = [&](std::string_view what, auto fill) {
    NetlinkRequest request(RTM_NEWLINK, NLM_F_ACK, link_of(index_));
    put_controller(request, [&] { fill(request); });
    return change(request, what);
  };
  // One by one, so that a refusal says which.
  if (settings.bitrate)
    if (auto failed = set("bit rate refused", [&](NetlinkRequest& request) {
          can_bittiming timing{};
          timing.bitrate = *settings.bitrate;
          request.put(IFLA_CAN_BITTIMING, timing);
        }))
      return failed;
  if (settings.listen_only)
    if (auto failed = set("listen-only refused by the driver", [&](NetlinkRequest& request) {
          request.put(IFLA_CAN_CTRLMODE,
                      can_ctrlmode{.mask = CAN_CTRLMODE_LISTENONLY,
                                   .flags = *settings.listen_only ? CAN_CTRLMODE_LISTENONLY : 0U});
        }))
      return failed;
  if (settings.restart_ms)
    if (auto failed = set("restart-ms refused by the driver", [&](NetlinkRequest& request) {
          request.put(IFLA_CAN_RESTART_MS, *settings.restart_ms);
        }))
      return failed;
  return settings.up ? set_up(true) : std::nullopt;
}

std::optional<Problem> CanInterface::restart() {
  if (hub_) return problem("has no controller to restart; it is up again when its hub is");
  if (!status_.has_controller) return problem(std::string(kNoController));
  NetlinkRequest request(RTM_NEWLINK, NLM_F_ACK, link_of(index_));
  put_controller(request, [&] { request.put(IFLA_CAN_RESTART, std::uint32_t{1}); });
  int error = 0;
  const auto refused = change(request, "cannot be restarted", &error);
  if (!refused || error == EPERM || error == ENODEV) return refused;
  // Not bus-off (but stuck), restarting by itself, or a driver that cannot.
  if (auto failed = set_up(false)) return failed;
  return set_up(true);
}

// A new queue in the place of the old one, which takes its frames with it: away with the one that
// an earlier flush() made, so that the kernel makes its own again; where there is none, make one.
// A queue that somebody else made has filters and classes that are not ours to lose.
std::optional<Problem> CanInterface::flush() {
  if (!status_.plain_queue)
    return problem("its queue is not the kernel's own and is left unchanged");
  tcmsg queue{};
  queue.tcm_family = AF_UNSPEC;
  queue.tcm_ifindex = index_;
  queue.tcm_parent = TC_H_ROOT;
  int error = 0;
  const auto kept =
      change(NetlinkRequest(RTM_DELQDISC, NLM_F_ACK, queue), "queue cannot be emptied", &error);
  if (error != ENOENT) return kept;
  NetlinkRequest request(RTM_NEWQDISC, NLM_F_ACK | NLM_F_CREATE | NLM_F_REPLACE, queue);
  request.put_text(TCA_KIND, kPlainQueue);
  return change(request, "queue cannot be emptied");
}

}  // namespace pitwall::transport
