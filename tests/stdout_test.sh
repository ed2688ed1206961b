#!/usr/bin/env bash
# Programs with a full or closed stdout report it once, and end with an exit code other than 0.
# Usage: stdout_test.sh PROGRAM...
set -euo pipefail
source "$(dirname "$0")/cli_test.bash"

# $1: the redirection, then the command
refused() {
  local got=0
  eval '"${@:2}" 2>"$work/log"' "$1" || got=$?
  [ "$got" -eq 1 ] || fail "exit code $got instead of 1 of ${*:2} $1: $(cat "$work/log")"
  [ "$(grep -c '' "$work/log")" -eq 1 ] && grep -q ": cannot write to stdout " "$work/log" || fail "${*:2} $1 says: $(cat "$work/log")"
}

for program in "$@"; do
  options=(--help)
  expect 0 "$program" --help
  case $(basename "$program") in
    falling_particles) options+=(--list --version) ;;
    hard_cases) options+=(--list) ;;
  esac
  for option in "${options[@]}"; do
    [ "$option" = --help ] || "$program" "$option" >/dev/null 2>&1 || continue
    for stdout in '>/dev/full' '>&-'; do refused "$stdout" "$program" "$option"; done
  done
done
echo "all passed"
