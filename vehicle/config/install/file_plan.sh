# shellcheck shell=bash disable=SC2154,SC2034  # shares variables with install.sh
# file_plan.sh: which files a folder tree lacks, and putting them there all or not at all.
#   in     plan_* calls: what is wanted; $target: the tree ('' is the live system); $manifest: the
#          record of the last installation, with checksums
#   out    one line per change on stdout: ACTION PATH OWNER MODE, then the difference for a replaced
#          text. apply prints the lines that a dry run prints
#   errors fail() of the sourcing script; until "committed" is 1 an exit puts everything back
#   law    a file of kind config that was edited here stays: a new version goes beside it as .new.
#          Units are not config: systemd has drop-ins for edits
# SPDX-License-Identifier: Apache-2.0

# The plan, one index a change: what it is, where, and what it looks like.
plan_kind=() plan_action=() plan_path=() plan_mode=() plan_source=()
declare -A planned=()                  # every path that is wanted, changed or not
declare -A old_kind=() old_sum=() new_kind=() new_sum=()  # the manifest, by path
old_order=() new_order=()
done_paths=() made_folders=()
committed=0

# Only these may stand in a manifest, so that a damaged one removes nothing else.
may_be_ours() {
  [[ $1 != *..* ]] || return 1
  case $1 in
    /opt/pitwall/* | /usr/local/bin/pitwall-base | /usr/lib/*/wireshark/plugins/pitwall.lua | \
      /etc/pitwall/* | /etc/systemd/system/pitwall-* | \
      /etc/systemd/system/*.wants/* | /etc/systemd/network/70-pitwall-* | \
      /etc/sysusers.d/pitwall.conf | /etc/sysctl.d/05-pitwall.conf | \
      /etc/security/limits.d/70-pitwall.conf | /etc/modules-load.d/pitwall.conf) return 0 ;;
    *) return 1 ;;
  esac
}

# Who may not write to this machine is told before anything is read.
may_change() {
  [[ -n $target ]] || ((dry_run || EUID == 0)) ||
    fail 'this machine can be changed by root only: sudo, or --root DIR for a tree of your own'
}

scratch='' owner=''
begin_plan() {
  trap on_exit EXIT
  trap 'exit 130' INT
  trap 'exit 143' TERM HUP
  scratch=$(mktemp -d)
  if ((EUID == 0)); then owner=root:root; else owner=$(id -un):$(id -gn); fi
  load_manifest
}

on_exit() {
  local code=$?
  set +e
  trap - EXIT
  if ((!dry_run && !committed)) && ((${#done_paths[@]} + ${#made_folders[@]} > 0)); then
    put_back
    printf 'pitwall: error: install: it failed on the way; everything is as it was\n' >&2
    code=1
  fi
  [[ -z $scratch ]] || rm -rf -- "$scratch"
  exit "$code"
}

say_manifest() {
  local action=create
  [[ ! -f $target$manifest ]] || action=replace
  changes || action=keep
  printf '%-8s %s %s 0644 (what is installed, with checksums)' "$action" "$manifest" "$owner"
}

load_manifest() {
  [[ -f $target$manifest ]] || return 0
  local kind sum path line=0
  while IFS=$'\t' read -r kind sum path; do
    line=$((line + 1))
    [[ $kind == folder && $path == /* && $path != *..* ]] ||
      { [[ $kind =~ ^(program|system|config|secret|link)$ ]] && may_be_ours "$path"; } ||
      fail "$target$manifest:$line: no line of ours; nothing was changed"
    old_kind[$path]=$kind old_sum[$path]=$sum
    old_order+=("$path")
  done <"$target$manifest"
}

checksum() {
  local sum
  sum=$(sha256sum <"$1")
  printf '%s' "${sum%% *}"
}

record() {
  [[ -n ${new_kind[$1]:-} ]] || new_order+=("$1")
  new_kind[$1]=$2 new_sum[$1]=$3
}

append() { # KIND ACTION PATH MODE SOURCE
  plan_kind+=("$1") plan_action+=("$2") plan_path+=("$3") plan_mode+=("$4") plan_source+=("$5")
}

# Every folder above PATH that is not there.
plan_folders() {
  local folder=${1%/*}
  [[ -n $folder && -z ${planned[$folder]:-} ]] || return 0
  plan_folders "$folder"
  planned[$folder]=1
  if [[ ! -d $target$folder ]]; then
    [[ ! -e $target$folder ]] || fail "$target$folder is in the way: no folder"
    append folder create "$folder" 0755 ''
    record "$folder" folder -
  elif [[ ${old_kind[$folder]:-} == folder ]]; then
    record "$folder" folder -
  fi
}

# plan_file KIND MODE PATH SOURCE: KIND program, system, config or secret (never shown).
plan_file() {
  local kind=$1 mode=$2 path=$3 source=$4 there=$target$3 wanted current
  plan_folders "$path"
  planned[$path]=1
  wanted=$([[ ! -f $source ]] || checksum "$source")
  if [[ ! -e $there && ! -L $there ]]; then
    append "$kind" create "$path" "$mode" "$source"
    record "$path" "$kind" "$wanted"
    return
  fi
  [[ -f $there && ! -L $there ]] || fail "$there is in the way: no regular file"
  current=$(checksum "$there")
  if [[ $current == "$wanted" ]] && same_attributes "$there" "$mode"; then
    append "$kind" keep "$path" "$mode" "$source"
    [[ -z ${old_kind[$path]:-} ]] || record "$path" "$kind" "$wanted"
  elif [[ $kind == config && $current != "$wanted" && $current != "${old_sum[$path]:-}" ]]; then
    plan_beside_edited "$mode" "$path" "$source" "$wanted"
  else
    append "$kind" replace "$path" "$mode" "$source"
    record "$path" "$kind" "$wanted"
  fi
}

plan_beside_edited() { # MODE PATH SOURCE WANTED
  local mode=$1 path=$2 source=$3 wanted=$4
  append config keep "$path" "$mode" "$source"
  note "$path was edited here and stays as it is"
  [[ -z ${old_kind[$path]:-} ]] || record "$path" config "${old_sum[$path]}"
  [[ $wanted != "${old_sum[$path]:-}" ]] || return 0
  note "the new version of $path goes beside it as ${path##*/}.new"
  plan_file system "$mode" "$path.new" "$source"
}

plan_link() { # PATH TARGET
  local path=$1 to=$2 there=$target$1
  plan_folders "$path"
  planned[$path]=1
  if [[ -L $there && $(readlink "$there") == "$to" ]]; then
    append link keep "$path" '' "$to"
    [[ -z ${old_kind[$path]:-} ]] || record "$path" link "$to"
    return
  fi
  [[ ! -e $there || -L $there ]] || fail "$there is in the way: no link"
  append link enable "$path" '' "$to"
  record "$path" link "$to"
}

# What an earlier installation left that is not wanted now goes; what was edited here stays. But for
# an uninstall ($1 is 1) the rest of /etc/pitwall stays too: an edited vehicle.env may name it.
plan_leftovers() {
  local path kind i
  for ((i = ${#old_order[@]} - 1; i >= 0; i--)); do
    path=${old_order[i]} kind=${old_kind[${old_order[i]}]}
    [[ -z ${planned[$path]:-} && (-e $target$path || -L $target$path) ]] || continue
    if [[ $kind == secret && $1 == 0 ]]; then
      append secret keep "$path" 0600 ''
      record "$path" secret "${old_sum[$path]}"
    elif [[ $kind != config ]]; then
      append "$kind" remove "$path" '' ''
    elif [[ $(checksum "$target$path") != "${old_sum[$path]}" ]]; then
      note "$path was edited here and stays"
      keep_leftover "$path"
    elif [[ $1 == 0 && $path == /etc/pitwall/* ]]; then
      keep_leftover "$path"
    else
      append config remove "$path" '' ''
    fi
  done
}

keep_leftover() {
  append config keep "$1" "0$(stat -c %a "$target$1")" ''
  record "$1" config "${old_sum[$1]}"
}

changes() {
  local action
  for action in "${plan_action[@]}"; do [[ $action == keep ]] || return 0; done
  return 1
}

same_attributes() { # FILE MODE
  [[ 0$(stat -c %a "$1") == "$2" ]] || return 1
  ((EUID != 0)) || [[ $(stat -c %U:%G "$1") == root:root ]]
}

show_line() {
  local i=$1 action=${plan_action[$1]} path=${plan_path[$1]}
  case ${plan_kind[i]}:$action in
    folder:remove) printf '%-8s %s/ (if empty)\n' "$action" "$path" ;;
    folder:*) printf '%-8s %s/ %s %s\n' "$action" "$path" "$owner" "${plan_mode[i]}" ;;
    *:remove) printf '%-8s %s\n' "$action" "$path" ;;
    link:*) printf '%-8s %s -> %s\n' "$action" "$path" "${plan_source[i]}" ;;
    program:*)
      printf '%-8s %s %s %s%s\n' "$action" "$path" "$owner" "${plan_mode[i]}" \
        "$([[ -f ${plan_source[i]} ]] || echo ' (not built yet)')"
      ;;
    *) printf '%-8s %s %s %s\n' "$action" "$path" "$owner" "${plan_mode[i]}" ;;
  esac
  [[ $action != replace || ${plan_kind[i]} =~ ^(program|secret)$ ]] ||
    diff -u --label "$path (as it is)" --label "$path (as it will be)" \
      "$target$path" "${plan_source[i]}" || true
}

show_plan() {
  local i
  for i in "${!plan_path[@]}"; do show_line "$i"; done
}

# Everything that can run out of room happens here, beside the places where it will be needed.
stage_plan() {
  local i there
  for i in "${!plan_path[@]}"; do
    there=$target${plan_path[i]}
    case ${plan_kind[i]}:${plan_action[i]} in
      folder:create)
        mkdir -m "${plan_mode[i]}" -- "$there"
        made_folders+=("$there")
        ;;
      link:enable) ln -sfn -- "${plan_source[i]}" "$there.pitwall-new" ;;
      *:create | *:replace)
        install -m "${plan_mode[i]}" -- "${plan_source[i]}" "$there.pitwall-new"
        ;;
    esac
  done
}

# One rename for each change; the old file stays beside it until all are done.
commit_plan() {
  local i there
  for i in "${!plan_path[@]}"; do
    there=$target${plan_path[i]}
    show_line "$i"
    [[ ${plan_kind[i]} != folder && ${plan_action[i]} != keep ]] || continue
    swap "$there" "${plan_action[i]}"
  done
}

swap() { # PATH ACTION
  if [[ -e $1 || -L $1 ]]; then
    ln -fT -- "$1" "$1.pitwall-old"
  elif [[ -e $1.pitwall-old || -L $1.pitwall-old ]]; then
    rm -f -- "$1.pitwall-old"
  fi
  done_paths+=("$1")
  if [[ $2 == remove ]]; then rm -- "$1"; else mv -T -- "$1.pitwall-new" "$1"; fi
}

write_manifest() {
  local path text=''
  for path in "${new_order[@]}"; do
    text+="${new_kind[$path]}"$'\t'"${new_sum[$path]}"$'\t'"$path"$'\n'
  done
  printf '%s' "$text" >"$1"
}

# The manifest goes first: whatever happens then, it names every file of ours that may be there.
apply_plan() {
  stage_plan
  write_manifest "$target$manifest.pitwall-new"
  chmod 0644 "$target$manifest.pitwall-new"
  swap "$target$manifest" replace
  commit_plan
  finish_plan
}

apply_removal() {
  commit_plan
  [[ ! -f $target$manifest ]] || swap "$target$manifest" remove
  finish_plan
}

finish_plan() {
  local i
  committed=1
  rm -f -- "${done_paths[@]/%/.pitwall-old}"
  for i in "${!plan_path[@]}"; do
    [[ ${plan_kind[i]}:${plan_action[i]} != folder:remove ]] ||
      rmdir --ignore-fail-on-non-empty -- "$target${plan_path[i]}" 2>/dev/null || true
  done
}

put_back() {
  local i there
  for ((i = ${#done_paths[@]} - 1; i >= 0; i--)); do
    there=${done_paths[i]}
    if [[ -f $there.pitwall-old || -L $there.pitwall-old ]]; then
      mv -fT -- "$there.pitwall-old" "$there"
    else
      rm -f -- "$there"
    fi
  done
  for i in "${!plan_path[@]}"; do
    [[ -d $target${plan_path[i]}.pitwall-new ]] || rm -f -- "$target${plan_path[i]}.pitwall-new"
  done
  rm -f -- "$target$manifest.pitwall-new"
  for ((i = ${#made_folders[@]} - 1; i >= 0; i--)); do rmdir -- "${made_folders[i]}"; done
}
