#!/bin/sh
# own_network.sh COMMAND...: runs it where only loopback exists, with multicast on it. Nothing
# of it leaves the machine, nothing else is heard, and no port is taken. Shared memory is its own:
# Fast DDS names it by port. Root stays root of the machine and may go on asking for SCHED_FIFO,
# which the root of a user namespace of its own may not.
# SPDX-License-Identifier: Apache-2.0
if unshare -nm true 2>/dev/null; then flags=-nm; else flags=-rnm; fi
exec unshare "$flags" sh -c 'mount -t tmpfs tmpfs /dev/shm &&
  ip link set lo up multicast on && ip route add 224.0.0.0/4 dev lo && exec "$@"' sh "$@"
