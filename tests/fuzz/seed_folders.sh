#!/usr/bin/env bash
# seed_folders.sh FUZZER: prints the folders of real inputs for it that exist; read where they are.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail

root=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../..
root=$(readlink -f "$root")
shared=${PITWALL_SHARED_DATA:-$root/../shared/data}
folders=("$root/tests/fuzz/seeds/$1")
case $1 in
  # One reader of several: of the seeds of all of them, its own.
  fuzz_can_log_*) folders=("$root/tests/fuzz/seeds/fuzz_can_log/${1#fuzz_can_log_}") ;;
  fuzz_recording_*) folders=("$root/tests/fuzz/seeds/fuzz_recording/${1#fuzz_recording_}") ;;
  *dbc* | *manifest*) folders+=("$root/protocol/can/dbc" "$shared/dbc") ;;
  *scenario*) folders+=("$root/hil/scenarios") ;;
  *car* | *yaml* | *param* | *track*) folders+=("$root/vehicle/config") ;;
  *gnss* | *novatel* | *vectornav*) folders+=("$shared/gnss") ;;
esac
for folder in "${folders[@]}"; do
  if [[ -d $folder ]]; then printf '%s\n' "$folder"; fi
done
