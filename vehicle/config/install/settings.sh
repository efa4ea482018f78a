# The command line of install.sh: what a person may say, and the check of each word. Sourced by it.
#   in     the words; usage and refuse of install.sh; top, its source tree
#   out    the variables below, and target, dry_run, uninstall
#   errors refuse, with the option by name
# shellcheck shell=bash disable=SC2034
# SPDX-License-Identifier: Apache-2.0

target='' dry_run=0 uninstall=0 settings=()
can=can0 bitrate=500000 restart_ms=0 listen_only=0
car=$top/vehicle/config/cars/av21.yaml track=$top/vehicle/config/tracks/lvms.yaml
radio=127.0.0.1:23431 keys=''
receiver=(udp:23501 udp:23502) guardian_receiver=(udp:23511 udp:23512)
build=$top/build/release

# check_number OPTION VALUE LOW HIGH
check_number() {
  if [[ ! $2 =~ ^(0|[1-9][0-9]{0,8})$ ]] || (($2 < $3 || $2 > $4)); then
    refuse "$1 needs a whole number, $3..$4, got '$2'"
  fi
}

check_file() { # OPTION FILE
  [[ -f $2 && -r $2 ]] || refuse "$1: no readable file '$2'"
  [[ ${2##*/} =~ ^[A-Za-z0-9_][A-Za-z0-9_.-]*\.yaml$ ]] ||
    refuse "$1: a file name is of letters, digits, '_', '.', '-' and ends in .yaml, got '${2##*/}'"
}

check_can() {
  [[ $1 =~ ^[A-Za-z][A-Za-z0-9_]{0,14}$ ]] ||
    refuse "--can needs an interface name of letters, digits and '_', 15 at most, got '$1'"
  [[ ! $1 =~ ^vx?can ]] ||
    refuse "--can $1 is a virtual bus without bit rate; pitwall-hil bus up makes those"
}

byte='(25[0-5]|2[0-4][0-9]|1?[0-9]?[0-9])'
address="($byte\\.){3}$byte" port='[1-9][0-9]{0,4}'

# Its form; which addresses go together, the car process knows (check_config).
check_radio() {
  local station stations
  IFS=, read -ra stations <<<"$1"
  if [[ ! $1 =~ ^$address:$port(,$address:$port){0,3}$ ]]; then
    refuse '--radio needs ADDRESS:PORT[,ADDRESS:PORT...], four at most, with IPv4 addresses and' \
      "ports 1..65535, got '$1'"
  fi
  for station in "${stations[@]}"; do
    ((${station##*:} <= 65535)) || refuse "--radio needs ports 1..65535, got '$station'"
  done
}

check_keys() {
  [[ -f $1 && -r $1 ]] || refuse "--keys: no readable file '$1'"
  grep -qx 'role: car' "$1" || refuse "--keys: '$1' does not say 'role: car'"
  ! grep -q '^[[:blank:]]*use:' "$1" ||
    refuse "--keys: '$1' is for a bench: make a pair with 'pitwall-base keygen' without --bench"
}

check_gnss() { # OPTION VALUE
  if [[ ! $2 =~ ^[1-9][0-9]{0,4},[1-9][0-9]{0,4}$ ]] ||
    ((${2%,*} > 65535 || ${2#*,} > 65535 || ${2%,*} == ${2#*,})); then
    refuse "$1 needs two different ports 1..65535 as P0,P1, got '$2'"
  fi
}

# Its form; which device and which rate there can be, the car process knows (check_config).
check_link() { # OPTION UNIT=LINK
  local link=${2#*=}
  local serial='serial:/dev/[A-Za-z0-9_./-]+(:[1-9][0-9]{0,6})?'
  if [[ ! $2 =~ ^[01]=(udp:($address:)?$port|tcp:$address:$port|$serial)$ ]] ||
    { [[ $link != serial:* ]] && ((${link##*:} > 65535)); }; then
    refuse "$1 needs 0= or 1= and udp:[ADDRESS:]PORT, tcp:ADDRESS:PORT or" \
      "serial:/dev/DEVICE[:BAUD], got '$2'"
  fi
}

# A serial line is its device, whatever the rate.
line_of() { [[ $1 == serial:*:* ]] && printf '%s' "${1%:*}" || printf '%s' "$1"; }

check_links() {
  local i
  [[ $(line_of "${receiver[0]}") != "$(line_of "${receiver[1]}")" ]] ||
    refuse "--receiver: both receivers have ${receiver[0]}"
  [[ $(line_of "${guardian_receiver[0]}") != "$(line_of "${guardian_receiver[1]}")" ]] ||
    refuse "--guardian-receiver: both receivers have ${guardian_receiver[0]}"
  for i in "${guardian_receiver[@]}"; do
    [[ $(line_of "$i") != "$(line_of "${receiver[0]}")" &&
      $(line_of "$i") != "$(line_of "${receiver[1]}")" ]] ||
      refuse "--guardian-gnss or --guardian-receiver: the car's process has $i"
  done
}

check_root() {
  [[ -n $1 && -d $1 ]] || refuse "--root: no such folder '$1'"
  target=$(readlink -f -- "$1")
  [[ $target != / ]] || refuse '--root / is this machine: leave --root out'
}

parse() {
  while (($#)); do
    case $1 in
      --dry-run) dry_run=1 ;;
      --uninstall) uninstall=1 ;;
      --listen-only) listen_only=1 settings+=("$1") ;;
      --help | -h) usage; exit 0 ;;
      --can | --bitrate | --restart-ms | --car | --track | --radio | --keys | --gnss | \
        --guardian-gnss | --receiver | --guardian-receiver | --root | --build)
        (($# >= 2)) || refuse "$1 needs a value"
        [[ $1 == --root || $1 == --build ]] || settings+=("$1")
        take "$1" "$2"
        shift
        ;;
      *) refuse "unknown argument '$1'" ;;
    esac
    shift
  done
  ((!uninstall || !${#settings[@]})) || refuse "--uninstall takes no ${settings[0]}"
  check_links
}

take() { # OPTION VALUE
  case $1 in
    --can) check_can "$2"; can=$2 ;;
    --bitrate) check_number "$1" "$2" 10000 1000000; bitrate=$2 ;;
    --restart-ms) check_number "$1" "$2" 0 60000; restart_ms=$2 ;;
    --car) check_file "$1" "$2"; car=$2 ;;
    --track) check_file "$1" "$2"; track=$2 ;;
    --radio) check_radio "$2"; radio=$2 ;;
    --keys) check_keys "$2"; keys=$2 ;;
    --gnss) check_gnss "$1" "$2"; receiver=("udp:${2%,*}" "udp:${2#*,}") ;;
    --guardian-gnss) check_gnss "$1" "$2"; guardian_receiver=("udp:${2%,*}" "udp:${2#*,}") ;;
    --receiver) check_link "$1" "$2"; receiver[${2%%=*}]=${2#*=} ;;
    --guardian-receiver) check_link "$1" "$2"; guardian_receiver[${2%%=*}]=${2#*=} ;;
    --root) check_root "$2" ;;
    --build) [[ -d $2 ]] || refuse "--build: no such folder '$2'"; build=$(readlink -f -- "$2") ;;
  esac
}
