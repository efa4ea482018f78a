#!/usr/bin/env bash
# run_seeds.sh PROGRAM: runs a fuzzer that was linked with seed_runner.cpp on its own seeds.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail

mapfile -t folders < <("$(dirname "${BASH_SOURCE[0]}")/seed_folders.sh" "$(basename "$1")")
exec "$1" "${folders[@]}"
