#!/usr/bin/env bash
# install_station.sh base [OPTION]...: puts the base station on a machine of the pit wall (Debian
# 12) or takes it off: program, console, tracks, and the radio's dissector where Wireshark looks
# for it
#   in     built programs and console
#   out    one line per change: ACTION PATH OWNER MODE; actions create replace keep remove enable
#          note next. With --dry-run the same lines, and nothing is changed
#   errors 1 the work failed, and what it had changed is put back; 2 the command line is wrong
#   law    it starts nothing and opens no port; keys are made by `pitwall-base keygen` only
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail

here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
top=$(readlink -f "$here/../../..")
manifest=/var/lib/pitwall/base.manifest

usage() {
  cat <<'TEXT'
usage: ./pitwall install base [OPTION]...

  --dry-run         say what would change, and change nothing
  --wireshark DIR   folder of Wireshark's Lua plugins; default: the one that tshark names, or
                    Debian's
  --no-wireshark    without the dissector
  --uninstall       remove what was installed
  --root DIR        work on the tree in DIR (an image) instead of this machine
  --build DIR       the build with the programs (default build/release)
TEXT
}

fail() { printf 'pitwall: error: install: %s\n' "$*" >&2; exit 1; }
refuse() {
  printf 'pitwall: error: install: %s\nTry: ./pitwall install base --help\n' "$*" >&2
  exit 2
}
notes=()
note() { notes+=("$*"); }

# shellcheck source=vehicle/config/install/file_plan.sh
source "$top/vehicle/config/install/file_plan.sh"

target='' dry_run=0 uninstall=0 wireshark='' with_wireshark=1
build=$top/build/release console=$top/build/console/dist

parse() {
  while (($#)); do
    case $1 in
      --dry-run) dry_run=1 ;;
      --uninstall) uninstall=1 ;;
      --no-wireshark) with_wireshark=0 ;;
      --help | -h) usage; exit 0 ;;
      --root | --build | --wireshark)
        (($# >= 2)) || refuse "$1 needs a value"
        take "$1" "$2"
        shift
        ;;
      *) refuse "unknown argument '$1'" ;;
    esac
    shift
  done
}

take() { # OPTION VALUE
  case $1 in
    --root)
      [[ -n $2 && -d $2 ]] || refuse "--root: no such folder '$2'"
      target=$(readlink -f -- "$2")
      [[ $target != / ]] || refuse '--root / is this machine: leave --root out'
      ;;
    --build) [[ -d $2 ]] || refuse "--build: no such folder '$2'"; build=$(readlink -f -- "$2") ;;
    --wireshark)
      [[ $2 =~ ^/usr/lib/[A-Za-z0-9_-]+/wireshark/plugins$ ]] ||
        refuse "--wireshark needs a folder /usr/lib/*/wireshark/plugins, got '$2'"
      wireshark=$2
      ;;
  esac
}

# Where Wireshark looks for everybody's Lua plugins.
plugin_folder() {
  local named=''
  [[ -n $target ]] || ! command -v tshark >/dev/null ||
    named=$(tshark -G folders 2>/dev/null | sed -nE 's/^Global Lua Plugins:\s*(\S+?)\/?$/\1/p')
  [[ $named =~ ^/usr/lib/[A-Za-z0-9_-]+/wireshark/plugins$ ]] ||
    named=/usr/lib/$(uname -m)-linux-gnu/wireshark/plugins
  printf '%s' "${wireshark:-$named}"
}

plan_files() {
  local program=$build/basestation/pitwall-base file
  plan_folders "$manifest"
  plan_file program 0755 /opt/pitwall/bin/pitwall-base "$program"
  plan_link /usr/local/bin/pitwall-base /opt/pitwall/bin/pitwall-base
  # The program finds both beside itself.
  while IFS= read -r file; do
    plan_file system 0644 "/opt/pitwall/bin/console/$file" "$console/$file"
  done < <(cd "$console" && find . -type f -printf '%P\n' | sort)
  for file in "$top"/vehicle/config/tracks/*.yaml; do
    plan_file system 0644 "/opt/pitwall/bin/tracks/${file##*/}" "$file"
  done
  ((with_wireshark)) || return 0
  "$program" export lua >"$scratch/pitwall.lua" || fail "$program does not say what its packets are"
  plan_file system 0644 "$(plugin_folder)/pitwall.lua" "$scratch/pitwall.lua"
}

install_base() {
  local manifest_line
  [[ -x $build/basestation/pitwall-base ]] ||
    fail "$build/basestation/pitwall-base is not built: ./pitwall build"
  [[ -f $console/index.html ]] || fail "$console/index.html is not built: ./pitwall build"
  plan_files
  plan_leftovers 0
  manifest_line=$(say_manifest)
  if ((dry_run)) || ! changes; then show_plan; else apply_plan; fi
  printf '%s\n' "$manifest_line"
  note 'nothing was started; on a machine without them: pitwall-base keygen --out FOLDER'
}

uninstall_base() {
  [[ -f $target$manifest ]] || fail "nothing of ours is installed: no $target$manifest"
  plan_leftovers 1
  if ((dry_run)); then show_plan; else apply_removal; fi
  printf 'remove   %s\n' "$manifest"
}

[[ ${1:-} == --help || ${1:-} == -h ]] && { usage; exit 0; }
[[ ${1:-} == base ]] || refuse "install_station.sh installs base, got '${1:-}'"
shift
parse "$@"
may_change
begin_plan
if ((uninstall)); then uninstall_base; else install_base; fi
for one in "${notes[@]}"; do printf 'note     %s\n' "$one"; done
