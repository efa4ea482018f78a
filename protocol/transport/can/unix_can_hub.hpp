// The hub of a CAN bus `unix:PATH` (unix_bus says what goes over it): takes each frame from one
// client and gives it to all others.
//
//   invariants
//         one total order: any two clients hear the frames that both hear in the same order, and
//         each hears what was sent after its connect() returned
//         for each client: frames offered = frames in its queue or read + frames lost, and the last
//         notice it reads tells exactly the frames lost so far
//
//   A client's queue is the send buffer of its connection: a reader that is slow fills it, and
//   loses frames, counted and told in place; it delays nobody. What is no frame is refused and
//   counted. A client may be killed at any moment: what it sent until then is relayed.
//   in     PATH: its owner's only (0600). A socket that nobody serves any more is replaced; one
//          that is served, and whatever is no socket, is refused and left alone
//   out    frames; counters
//   errors open(): Problem with the interface as place; afterwards counters only
//   cost   serve(): for each client with frames one recvmmsg, one accept4 and one sendmmsg per
//          other client, for up to 64 frames; memory is allocated only when a client joins. A
//          classic frame takes 768 bytes of queue, as the kernel counts
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/un.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/transport/posix_call.hpp"
#include "protocol/vocabulary/result.hpp"
#include "protocol/vocabulary/time.hpp"

namespace pitwall::transport {

struct UnixCanHubOptions {
  int queue_bytes = 8 << 20;  // per client; the kernel doubles it: 21,846 classic frames
  std::size_t clients_max = 64;
};

struct UnixCanHubCounters {
  std::uint64_t relayed = 0;    // frames taken from a client and given to the others
  std::uint64_t delivered = 0;  // their copies put into queues
  std::uint64_t dropped = 0;    // copies lost because a client's queue was full
  std::uint64_t malformed = 0;  // packets that are no frame: refused
  std::uint64_t joined = 0, left = 0;
  std::uint64_t refused = 0;  // clients over the limit, or without a descriptor left for them
  // Of all clients, the one that lost most.
  std::uint64_t worst_dropped = 0;
  int worst_process = 0;  // its process id
};

std::string to_text(const UnixCanHubCounters& counters);

class UnixCanHub {
 public:
  static Result<std::unique_ptr<UnixCanHub>, Problem> open(std::string_view interface,
                                                           const UnixCanHubOptions& options = {});
  ~UnixCanHub();
  UnixCanHub(const UnixCanHub&) = delete;
  UnixCanHub& operator=(const UnixCanHub&) = delete;

  // Waits until the deadline for something to do, or until `stop` is readable, and does it.
  void serve(Instant deadline, int stop = -1);

  std::size_t clients() const { return clients_.size(); }
  const UnixCanHubCounters& counters() const { return counters_; }

 private:
  struct Client {
    FileDescriptor fd;
    std::uint64_t lost = 0;
    bool unreported = false;  // of some of them
    bool deaf = false;        // hears nothing, by its own wish or because it is about to leave
    bool gone = false;
    int process = 0;
  };
  struct Batch;

  UnixCanHub(const sockaddr_un& address, const UnixCanHubOptions& options);
  std::string claim();  // empty: the path is ours
  std::string make_room() const;
  void accept_all();
  void admit(FileDescriptor fd);
  void take_from(std::size_t sender);
  void relay(std::size_t sender, std::size_t frames);
  void give(Client& client, std::size_t frames);
  void publish(Client& client);
  void lose(Client& client, std::size_t frames);
  void sweep();

  sockaddr_un address_;
  UnixCanHubOptions options_;
  FileDescriptor listener_;
  std::uint64_t device_ = 0, node_ = 0;  // of the path, while it is ours
  Instant accept_from_{};                // not before: descriptors were short
  std::vector<Client> clients_;
  std::unique_ptr<Batch> batch_;
  UnixCanHubCounters counters_;
};

}  // namespace pitwall::transport
