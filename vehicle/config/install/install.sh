#!/usr/bin/env bash
# install.sh car [OPTION]...: puts Pitwall on a car's computer (Debian 12, systemd) or takes it off
#   in     templates beside this file, built programs, a car and a track file
#   out    one line per change: ACTION PATH OWNER MODE; actions create replace keep remove enable
#          user run note next. With --dry-run the same lines, and nothing is changed
#   errors 1 the work failed, and what it had changed is put back; 2 the command line is wrong
#   law    it never arms the car, never starts it, and never takes a running bus down
# SPDX-License-Identifier: Apache-2.0
set -euo pipefail

here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
top=$(readlink -f "$here/../../..")
manifest=/var/lib/pitwall/install.manifest
readonly tx_queue_frames=32 receive_buffer_bytes=8388608

usage() {
  cat <<'TEXT'
usage: ./pitwall install car [OPTION]...

  --dry-run              say what would change, and change nothing
  --can IFACE            CAN interface (default can0)
  --bitrate N            bit/s, 10000..1000000 (default 500000)
  --restart-ms N         so long after bus-off the kernel restarts the controller, 0..60000; 0: only
                         the car process does, a few times and then never (default 0)
  --listen-only          the controller hears and sends nothing: for the first look at a car
  --car FILE             car file (default vehicle/config/cars/av21.yaml)
  --track FILE           track file (default vehicle/config/tracks/lvms.yaml)
  --radio ADDRESS:PORT[,ADDRESS:PORT...]
                         where the base station is reached, IPv4 addresses: the first is preferred,
                         at the others are spare ones (default 127.0.0.1:23431)
  --keys FILE            the car's keys for the radio, as `pitwall-base keygen` writes them; goes to
                         /etc/pitwall/car.keys, readable by root only
  --gnss P0,P1           UDP ports of the two GNSS receivers (default 23501,23502)
  --guardian-gnss P0,P1  UDP ports to which they send a second time, for the guardian (default
                         23511,23512)
  --receiver UNIT=LINK   instead of --gnss, once for each receiver, UNIT 0 or 1; LINK is
                         udp:[ADDRESS:]PORT, tcp:ADDRESS:PORT or serial:/dev/DEVICE[:BAUD]
  --guardian-receiver UNIT=LINK
                         likewise instead of --guardian-gnss; never a link of the car's process
  --uninstall            remove what was installed; edited configuration stays
  --root DIR             work on the tree in DIR (an image) instead of this machine
  --build DIR            the build with the programs (default build/release)
TEXT
}

fail() { printf 'pitwall: error: install: %s\n' "$*" >&2; exit 1; }
refuse() {
  printf 'pitwall: error: install: %s\nTry: ./pitwall install car --help\n' "$*" >&2
  exit 2
}
notes=()
note() { notes+=("$*"); }

# shellcheck source=vehicle/config/install/file_plan.sh
source "$here/file_plan.sh"

# shellcheck source=vehicle/config/install/settings.sh
source "$here/settings.sh"

# --- what the car's computer gets ------------------------------------------------------------

# plan_rendered KIND PATH TEMPLATE: the template with its @NAMES@ filled in is planned for PATH.
plan_rendered() {
  local text name out=$scratch/$3
  local -A values=([IFACE]=$can [BITRATE]=$bitrate [RESTART_MS]=$restart_ms
    [LISTEN_ONLY_YES_NO]=no [LISTEN_ONLY_ON_OFF]=off [TX_QUEUE]=$tx_queue_frames
    [CAR]=${car##*/} [TRACK]=${track##*/} [RADIO]=$radio
    [RECEIVER_0]=${receiver[0]} [RECEIVER_1]=${receiver[1]}
    [GUARDIAN_RECEIVER_0]=${guardian_receiver[0]} [GUARDIAN_RECEIVER_1]=${guardian_receiver[1]})
  ((!listen_only)) || values[LISTEN_ONLY_YES_NO]=yes values[LISTEN_ONLY_ON_OFF]=on
  text=$(<"$here/$3")
  for name in "${!values[@]}"; do text=${text//"@$name@"/"${values[$name]}"}; done
  printf '%s\n' "$text" >"$out"
  plan_file "$1" 0644 "$2" "$out"
}

# The car file and those that it is like, which lie beside it.
plan_car_files() {
  local file=$car like
  for _ in 1 2 3 4; do
    plan_file config 0644 "/etc/pitwall/cars/${file##*/}" "$file"
    like=$(sed -nE 's/^like:[[:space:]]*"?([^"#[:space:]]+).*/\1/p' "$file")
    [[ -n $like ]] || return 0
    [[ $like != */* ]] ||
      refuse "$file: like: $like; expected a file beside it, because they are installed together"
    file=$(dirname "$file")/$like
    check_file "$car: like" "$file"
  done
}

# Programs in /opt: add-on software that no Debian package owns (FHS 3.13). Configuration and state
# where an administrator looks first.
plan_files() {
  plan_folders "$manifest"
  plan_file program 0755 /opt/pitwall/bin/pitwall-vehicle "$build/vehicle/pitwall-vehicle"
  plan_file program 0755 /opt/pitwall/bin/pitwall-guardian \
    "$build/vehicle/guardian/pitwall-guardian"
  plan_file program 0755 /opt/pitwall/bin/pitwall-hil "$build/hil/pitwall-hil"
  plan_car_files
  plan_file config 0644 "/etc/pitwall/tracks/${track##*/}" "$track"
  plan_rendered config /etc/pitwall/vehicle.env vehicle.env
  plan_keys
  plan_rendered system /etc/sysusers.d/pitwall.conf sysusers.conf
  plan_rendered system /etc/modules-load.d/pitwall.conf modules.conf
  plan_rendered config /etc/sysctl.d/05-pitwall.conf sysctl.conf
  plan_rendered config /etc/security/limits.d/70-pitwall.conf limits.conf
  plan_bus
  plan_rendered system /etc/systemd/system/pitwall-vehicle.service pitwall-vehicle.service
  plan_wanted_by_device pitwall-vehicle.service
  plan_rendered system /etc/systemd/system/pitwall-guardian.service pitwall-guardian.service
  plan_wanted_by_device pitwall-guardian.service
  plan_serial pitwall-vehicle.service "${receiver[@]}"
  plan_serial pitwall-guardian.service "${guardian_receiver[@]}"
  [[ $radio != 127.* ]] ||
    note "telemetry stays on this machine ($radio) until --radio says where the pit wall is"
}

# A unit sees no device and its user may open none, except the serial lines of its receivers.
plan_serial() { # UNIT LINK...
  local unit=$1 link out
  shift
  [[ "$*" == *serial:* ]] || return 0
  out=$scratch/$unit.serial
  printf '%s\n' '# Serial lines of receivers.' '[Service]' 'SupplementaryGroups=dialout' \
    'PrivateDevices=no' 'DevicePolicy=closed' >"$out"
  for link; do
    [[ $link != serial:* ]] || printf 'DeviceAllow=%s rw\n' "$(line_of "$link" | cut -d: -f2)"
  done >>"$out"
  plan_file system 0644 "/etc/systemd/system/$unit.d/serial.conf" "$out"
}

# Root's alone: systemd hands the service a copy (LoadCredential).
plan_keys() {
  [[ -z $keys ]] || plan_file secret 0600 /etc/pitwall/car.keys "$keys"
  [[ -n $keys || -f $target/etc/pitwall/car.keys ]] ||
    note 'no keys for the radio yet (pitwall-base keygen): without --keys the car does not start'
}

# The controller appears, the unit starts: also after an adapter was pulled and put back.
plan_wanted_by_device() {
  plan_link "/etc/systemd/system/sys-subsystem-net-devices-$can.device.wants/$1" \
    "/etc/systemd/system/$1"
}

networkd_link=/etc/systemd/system/multi-user.target.wants/systemd-networkd.service

# The interfaces that a file of ifupdown sets up.
stanzas() { awk '$1 == "iface" {print $2}' "$1"; }

# Says on one line who else manages the network; nothing if nobody does.
other_manager() {
  local file
  if [[ -L $target/etc/systemd/system/multi-user.target.wants/NetworkManager.service ]]; then
    echo NetworkManager
    return
  fi
  for file in "$target"/etc/network/interfaces "$target"/etc/network/interfaces.d/*; do
    if [[ -f $file ]] && stanzas "$file" | grep -vx lo >/dev/null; then
      echo "ifupdown (${file#"$target"})"
      return
    fi
  done
}

# systemd-networkd, or a unit of our own where enabling networkd would put a second manager on the
# machine. Neither touches any other interface.
plan_bus() {
  local other
  other=$(other_manager)
  if [[ -L $target$networkd_link && ${old_kind[$networkd_link]:-} != link || -z $other ]]; then
    plan_rendered config "/etc/systemd/network/70-pitwall-$can.network" can.network
    plan_rendered config "/etc/systemd/network/70-pitwall-$can.link" can.link
    [[ -L $target$networkd_link && ${old_kind[$networkd_link]:-} != link ]] ||
      plan_link "$networkd_link" /lib/systemd/system/systemd-networkd.service
  else
    note "$other manages this machine: systemd-networkd is not enabled," \
      "pitwall-can-$can.service sets $can up"
    plan_rendered system "/etc/systemd/system/pitwall-can-$can.service" pitwall-can.service
    plan_wanted_by_device "pitwall-can-$can.service"
  fi
  note_rivals
}

# Others that would set up the same interface: said, never changed.
note_rivals() {
  local file
  for file in "$target"/etc/network/interfaces "$target"/etc/network/interfaces.d/*; do
    [[ ! -f $file ]] || ! stanzas "$file" | grep -x "$can" >/dev/null ||
      note "${file#"$target"} sets up $can too: take it out there"
  done
  for file in "$target"/etc/systemd/network/*.network; do
    [[ ! -f $file || ${file##*/} == 70-pitwall-* ]] || ! grep -q '^\[CAN\]' "$file" ||
      note "${file#"$target"} sets up CAN too: of two files that match $can" \
        'networkd takes the first by name'
  done
}

# Shared libraries that an image lacks, as Debian packages.
note_missing_libraries() {
  local program=$build/vehicle/pitwall-vehicle library missing=() packages
  [[ -n $target && -x $program ]] && command -v dpkg-query >/dev/null || return 0
  while read -r library; do
    [[ -e $target$library || -e $target/usr$library ]] ||
      missing+=("$library" "$(readlink -f "$library")")
  done < <(ldd "$program" 2>/dev/null | awk '$3 ~ /^\// {print $3}')
  ((${#missing[@]})) || return 0
  packages=$({ dpkg-query -S "${missing[@]}" 2>/dev/null || true; } | cut -d: -f1 | sort -u | xargs)
  note "the tree lacks Debian packages that the programs need: $packages"
}

# --- the living system -----------------------------------------------------------------------

commands=()
user_line=''

plan_user() {
  if [[ -n $target ]]; then
    [[ -e $target/etc/sysusers.d/pitwall.conf ]] && user_line='keep     user pitwall' ||
      user_line='user     pitwall, a system user; systemd-sysusers makes it at the next boot'
  elif id -u pitwall &>/dev/null; then
    user_line='keep     user pitwall'
  else
    user_line='user     pitwall, a system user'
    commands+=('systemd-sysusers /etc/sysusers.d/pitwall.conf')
  fi
}

# Nothing here stops a program or takes an interface down; `networkctl reload` would.
plan_commands() {
  [[ -z $target ]] && changes || return 0
  commands+=('/lib/systemd/systemd-modules-load /etc/modules-load.d/pitwall.conf')
  (($(cat /proc/sys/net/core/rmem_max) >= receive_buffer_bytes)) ||
    commands+=('/lib/systemd/systemd-sysctl /etc/sysctl.d/05-pitwall.conf')
  commands+=('systemctl daemon-reload')
}

run_commands() {
  local command failed=0
  for command in "${commands[@]}"; do
    printf 'run      %s\n' "$command"
    ((dry_run)) || $command || { failed=1; printf 'note     failed: %s\n' "$command"; }
  done
  return $failed
}

say_next() {
  local n
  for n in "${notes[@]}"; do printf 'note     %s\n' "$n"; done
  ((!uninstall)) && [[ -z $target ]] && changes || return 0
  printf 'next     it starts, disarmed, when %s appears, as at a boot; without one:\n' "$can"
  if [[ -n ${planned["/etc/systemd/system/pitwall-can-$can.service"]:-} ]]; then
    printf 'next       systemctl restart pitwall-can-%s\n' "$can"
  else
    printf 'next       udevadm trigger --action=add /sys/class/net/%s\n' "$can"
    printf 'next       systemctl start systemd-networkd\n'
    printf 'next       networkctl reload && networkctl reconfigure %s\n' "$can"
  fi
  printf 'next       systemctl restart pitwall-guardian pitwall-vehicle\n'
}

# --- the two ways ----------------------------------------------------------------------------

install_car() {
  local program manifest_line
  check_config
  plan_files
  plan_user
  plan_leftovers 0
  note_missing_libraries
  plan_commands
  for program in vehicle/pitwall-vehicle vehicle/guardian/pitwall-guardian hil/pitwall-hil; do
    [[ -x $build/$program ]] || ((dry_run)) || fail "$build/$program is not built: ./pitwall build"
  done
  manifest_line=$(say_manifest)
  if ((dry_run)) || ! changes; then show_plan; else apply_plan; fi
  printf '%s\n' "$manifest_line" "$user_line"
  run_commands || fail 'the files are in place, but a command failed'
}

uninstall_car() {
  [[ -f $target$manifest ]] || fail "nothing of ours is installed: no $target$manifest"
  plan_leftovers 1
  [[ -z $target ]] || note 'on a system that has run, the user pitwall stays'
  if [[ -z $target ]]; then
    # The car's process first: the guardian takes its end for what it is, a process that disarmed.
    printf 'run      systemctl stop pitwall-vehicle pitwall-guardian\n'
    ((dry_run)) || { systemctl stop pitwall-vehicle && systemctl stop pitwall-guardian; } ||
      fail 'pitwall-vehicle or pitwall-guardian does not stop'
    note 'the user pitwall and its data in /var/lib/pitwall/vehicle stay'
    note 'the CAN interface stays as it is until the next boot'
    commands=('systemctl daemon-reload')
  fi
  if ((dry_run)); then show_plan; else apply_removal; fi
  printf 'remove   %s\n' "$manifest"
  run_commands || fail 'the files are gone, but a command failed'
}

# The car process refuses a wrong file too, but only when it starts. In a dry run the programs may
# be of another day than the files, so there it is only said.
check_config() {
  local said
  [[ -x $build/vehicle/pitwall-vehicle ]] || return 0
  said=$("$build/vehicle/pitwall-vehicle" --check --car "$car" --track "$track" --can "$can" \
    --receiver "0=${receiver[0]}" --receiver "1=${receiver[1]}" --radio "$radio" 2>&1) && return
  ((dry_run)) || refuse "the car process refuses its files: ${said%%$'\n'*}"
  note "the car process, as built now, refuses its files: ${said%%$'\n'*}"
}

[[ ${1:-} == --help || ${1:-} == -h ]] && { usage; exit 0; }
[[ ${1:-} == car ]] || refuse "install needs what to install: car or base, got '${1:-}'"
shift
parse "$@"
may_change
[[ -n $target || $dry_run == 1 || -d /run/systemd/system ]] ||
  fail 'this machine was not started by systemd; --root DIR installs into a tree'
check_file --car "$car"
check_file --track "$track"
begin_plan
if ((uninstall)); then uninstall_car; else install_car; fi
say_next
