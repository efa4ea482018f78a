// Hub of a CAN bus `unix:PATH` (protocol in unix_bus): forwards each frame of a client to all other
// clients.
//
//   invariants
//         one total order: any two clients receive their common frames in the same order, and each
//         client receives the frames sent after its connect() returned
//         for each client: frames offered = frames in its queue or read + frames lost, and the last
//         notice that it reads has the exact number of frames lost so far
//
//   A client's queue is the send buffer of its connection. A slow reader fills it and loses frames,
//   which are counted and reported at their place; it does not delay other clients. A packet that
//   is not a frame is refused and counted. If a client is killed, the frames it sent are forwarded.
//   in     PATH, as unix_listener.hpp has it
//   out    frames; counters
//   errors open(): Problem with the interface as place; afterwards counters only
//   cost   serve(): for each client with frames one recvmmsg, one accept4 and one sendmmsg per
//          other client, for up to 64 frames; memory is allocated only when a client joins. The
//          kernel counts 768 bytes of queue for a classic frame
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/transport/posix_call.hpp"
#include "protocol/transport/unix_listener.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

struct UnixCanHubOptions {
  int queue_bytes = 8 << 20;  // per client; the kernel doubles it: 21,846 classic frames
  std::size_t clients_max = 64;
};

struct UnixCanHubCounters {
  std::uint64_t relayed = 0;    // frames forwarded from a client to the others
  std::uint64_t delivered = 0;  // copies put into queues
  std::uint64_t dropped = 0;    // copies lost because a client's queue was full
  std::uint64_t malformed = 0;  // packets refused because they are not a frame
  std::uint64_t joined = 0, left = 0;
  std::uint64_t refused = 0;  // clients over the limit, or without a free descriptor for them
  // The client with the most lost frames: their number and its process id.
  std::uint64_t worst_dropped = 0;
  int worst_process = 0;
};

std::string to_text(const UnixCanHubCounters& counters);

class UnixCanHub {
 public:
  static Result<std::unique_ptr<UnixCanHub>, Problem> open(std::string_view interface,
                                                           const UnixCanHubOptions& options = {});
  ~UnixCanHub();
  UnixCanHub(const UnixCanHub&) = delete;
  UnixCanHub& operator=(const UnixCanHub&) = delete;

  // Waits until the deadline for packets and clients, or until `stop` is readable, and serves them.
  void serve(Instant deadline, int stop = -1);

  std::size_t clients() const { return clients_.size(); }
  const UnixCanHubCounters& counters() const { return counters_; }

 private:
  struct Client {
    FileDescriptor fd;
    std::uint64_t lost = 0;
    bool unreported = false;  // some losses are not yet reported
    bool rx_closed = false;   // gets no frames, by its own shutdown or because it is leaving
    bool gone = false;
    int process = 0;
  };
  struct Batch;

  UnixCanHub(UnixListener listener, const UnixCanHubOptions& options);
  void accept_all();
  void admit(FileDescriptor fd);
  void take_from(std::size_t sender);
  void relay(std::size_t sender, std::size_t frames);
  void give(Client& client, std::size_t frames);
  void publish(Client& client);
  void lose(Client& client, std::size_t frames);
  void sweep();

  UnixListener listener_;
  UnixCanHubOptions options_;
  Instant accept_from_{};  // earliest next accept, after a lack of descriptors
  std::vector<Client> clients_;
  std::unique_ptr<Batch> batch_;
  UnixCanHubCounters counters_;
};

}  // namespace pitwall::transport
