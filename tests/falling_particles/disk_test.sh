#!/usr/bin/env bash
# A disk that is full, and folders that cannot be written: one clear message, and the results of an earlier run stay as they were.
# Usage: disk_test.sh PROGRAM SAMPLES_FOLDER
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
program=$1
samples=$2
out=$work/out
formats='page glb lammps vtk povray plots'

# What another program draws takes as long as a shell script.
mkdir "$work/fakes"
for name in gnuplot povray; do
  printf '#!/bin/sh\nprintf "%%60000s" picture\n' >"$work/fakes/$name"
  chmod +x "$work/fakes/$name"
done
PATH=$work/fakes:$PATH

# A short run, with or without an earlier one's results. $1: format
run() {
  sed -e 's/^duration = .*/duration = 0.01/' -e '/^\[output\]/,$d' "$samples/scenes/short.toml" >"$work/scenes/short.toml"
  printf '\n[output]\npictures = ["%s"]\n' "$1" >>"$work/scenes/short.toml"
  shift
  "$@" "$program" -q --scene "$work/scenes/short.toml" --out "$out"
}

checksums() { (cd "$out" && find . -type f -not -name filler -exec sha256sum {} + | sort); }

# A run that may run out of space. With all its files, or with one line that names a file and the reason and the results of the
# earlier run as they were; but for what is drawn when the new ones are in their place. $1: format, $2: the reason, then the command
# that runs it
run_with_little_space() {
  local before format=$1 reason=$2 got=0
  before=$(checksums)
  # Through a pipe, because the log is a file, too.
  run "$format" "${@:3}" 2>&1 >/dev/null | cat >"$work/log" || got=$?
  [ -z "$(find "$out" -name '*.unfinished-*')" ] || fail "left behind: $(ls -A "$out")"
  case $got in
    0)
      whole=$((whole + 1))
      [ ! -s "$work/log" ] || fail "$(cat "$work/log")"
      ;;
    1)
      [ "$(wc -l <"$work/log")" -eq 1 ] || fail "not one line: $(cat "$work/log")"
      grep -qE "^falling_particles: cannot (write|create( output folder)?) \"$out/.*\": $reason\$" "$work/log" || fail "unclear: $(cat "$work/log")"
      echo "$format: $(grep -o '[^/]*": ' "$work/log")" >>"$work/named"
      if grep -qE '/short/[a-z]*\.(svg|png)"' "$work/log"; then
        [ -s "$out/short/summary.toml" ] || fail "a picture that could not be drawn has taken the results away"
      else
        [ "$(checksums)" = "$before" ] || fail "the earlier results have changed"
      fi
      ;;
    *) fail "exit code $got: $(cat "$work/log")" ;;
  esac
}

# With a limit for the size of a file, which takes no privileges.
no_file_larger() {
  local format size whole
  : >"$work/named"
  for format in $formats; do
    run "$format" env >/dev/null
    whole=0
    for size in 10 $(find "$out" -type f -printf '%s\n' | sort -nu); do
      run_with_little_space "$format" 'File too large' limited $((size * 99 / 100))  # the page holds the time that a run took
    done
    run_with_little_space "$format" '' limited $((size * 2))
    [ "$whole" -gt 0 ] || fail "$format: no run was whole"
  done
  local file
  for file in view.html scene.glb grains.lammpstrj grains_000000.vtp still.png energies.svg trajectory.csv; do
    grep -q ": $file\": " "$work/named" || fail "no run failed with $file: $(sort -u "$work/named")"
  done
}
limited() { prlimit --fsize="$1" "${@:2}"; }

# On a disk of 16 MB of which fewer and fewer pages are free. In a namespace with a file system of its own.
disk_gets_full() {
  local format free whole
  mkdir -p "$out" && mount -t tmpfs -o size=16m tmpfs "$out"
  : >"$work/named"
  for format in $formats; do
    rm -f "$out/filler"
    run "$format" env >/dev/null
    whole=0
    for free in 0 1 2 3 4 6 7 8 9 10 11 12 14 16 18 20 64 1500; do  # pages
      rm -f "$out/filler"
      head -c $((($(stat -f -c %a "$out") - free) * $(stat -f -c %S "$out"))) /dev/zero >"$out/filler"
      run_with_little_space "$format" 'No space left on device'
    done
    [ "$whole" -gt 0 ] || fail "$format: no run was whole"
  done
  local file
  for file in view.html scene.glb still.pov grains.lammpstrj grains_000001.vtp summary.toml trajectory.csv; do
    grep -q ": $file\": " "$work/named" || fail "no run failed with $file: $(sort -u "$work/named")"
  done
  rm -f "$out/filler"
  mount -o remount,ro "$out"
  refused 'Read-only file system'
}

# A folder that cannot be written is bad input. $1: the reason, then the command that runs the program
refused() {
  local before got=0
  before=$(checksums)
  run glb "${@:2}" >"$work/summary" 2>"$work/log" || got=$?
  [ "$got" -eq 2 ] || fail "exit code $got instead of 2: $(cat "$work/log")"
  grep -qx "cannot create output folder \"$out/short\": $1" "$work/log" || fail "unclear: $(cat "$work/log")"
  [ "$(checksums)" = "$before" ] || fail "the earlier results have changed"
  [ ! -s "$work/summary" ] || fail "a summary without a run"
}

folders_are_protected() {
  local as_user=(env)
  run glb env >/dev/null
  if [ "$(id -u)" -eq 0 ]; then  # whom nothing is protected from
    as_user=(setpriv --reuid=65534 --regid=65534 --clear-groups)
    chmod 755 "$work"
    if ! "${as_user[@]}" "$program" --help >/dev/null 2>&1; then
      echo "another user cannot run the program: protected folders are not tried" >&2
      return 0
    fi
    chown -R 65534 "$out"
  fi
  chmod 555 "$out"
  refused 'Permission denied' "${as_user[@]}"
  chmod 755 "$out" && chmod 555 "$out/short"
  refused 'Permission denied' "${as_user[@]}"
  chmod 755 "$out/short"
}

a_file_in_the_place_of_a_folder() {
  local got=0
  echo mine >"$work/file"
  "$program" -q --scene "$samples/scenes/short.toml" --out "$work/file/below" >"$work/log" 2>&1 || got=$?
  [ "$got" -eq 2 ] || fail "exit code $got instead of 2"
  grep -qx "cannot create output folder \"$work/file/below/short\": Not a directory" "$work/log" || fail "unclear: $(cat "$work/log")"
  [ "$(cat "$work/file")" = mine ] || fail "the file has changed"
}

mkdir "$work/scenes" && cp -r "$samples/data" "$work/data"
if [ "${3:-}" = --in-namespace ]; then
  trap 'umount "$out"; rm -rf "$work"' EXIT
  disk_gets_full
  exit
fi
no_file_larger
folders_are_protected
a_file_in_the_place_of_a_folder
if unshare --user --map-root-user --mount true 2>/dev/null; then
  unshare --user --map-root-user --mount "$0" "$program" "$samples" --in-namespace
else
  echo "no namespaces for users: a full disk is not tried" >&2
fi
echo "all passed"
