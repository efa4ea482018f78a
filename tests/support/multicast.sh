#!/bin/sh
# multicast.sh COMMAND...: runs it where nothing but loopback exists, with multicast on it, so that
# nothing of it leaves the machine and nothing else is heard.
# SPDX-License-Identifier: Apache-2.0
exec unshare "$("$(dirname "$0")/own_network")" sh -c 'ip link set lo up multicast on &&
  ip route add 224.0.0.0/4 dev lo && exec "$@"' sh "$@"
