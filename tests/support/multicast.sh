#!/bin/sh
# multicast.sh COMMAND...: runs it where nothing but loopback exists, with multicast on it, so that
# nothing of it leaves the machine, nothing else is heard, and no port is taken. Shared memory is
# its own too: Fast DDS names it by port.
# SPDX-License-Identifier: Apache-2.0
exec unshare "$("$(dirname "$0")/own_network")" sh -c 'mount -t tmpfs tmpfs /dev/shm &&
  ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec "$@"' sh "$@"
