#!/usr/bin/env bash
# same_bytes.sh PROGRAM_A PROGRAM_B SCENARIO SECONDS: both programs must write the same event log,
# and each must write it again on a second run.
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
for program in "$1" "$2"; do
  [[ -x $program ]] || { echo "missing: $program (./pitwall build debug)" >&2; exit 1; }
done
run() { # PROGRAM FILE; a failed expectation (1) is no matter here, a bench failure (2) is
  local code=0
  "$1" run "$3" --duration "$4" --log "$folder/$2" >"$folder/$2.txt" || code=$?
  ((code <= 1)) || { cat "$folder/$2.txt" >&2; exit 1; }
}
run "$1" a1 "$3" "$4"
run "$1" a2 "$3" "$4"
run "$2" b "$3" "$4"
(cd "$folder" && sha256sum a1 a2 b)
printed=$(sed -n 's/^event log SHA-256 //p' "$folder/a1.txt")
counted=$(sha256sum <"$folder/a1" | cut -d' ' -f1)
[[ $printed == "$counted" ]] || { echo "the printed digest is not the file's" >&2; exit 1; }
cmp "$folder/a1" "$folder/a2"
cmp "$folder/a1" "$folder/b"
