#!/usr/bin/env bash
# The soak program from outside: the number of threads changes nothing, pieces add up, mistakes are reported.
# Usage: soak_cli_test.sh PROGRAM
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
program=$1

# A number of the state file $1. $2: its name
value() { sed -n "s/^$2 //p" "$work/$1"; }

expect 0 "$program" --queries 4000 --seed 3 --threads 1 --resume "$work/one"
expect 0 "$program" --queries 4000 --seed 3 --threads 3 --resume "$work/three"
cmp <(grep -v '^seconds ' "$work/one") <(grep -v '^seconds ' "$work/three") || fail "threads change the result"

cp "$work/one" "$work/pieces"
expect 0 "$program" --queries 8000 --seed 3 --resume "$work/pieces"
[ "$(value pieces queries)" -ge 8000 ] && [ "$(value pieces queries)" -lt 8100 ] || fail "pieces do not add up: $(value pieces queries)"
[ "$(value pieces samples)" -gt "$(value one samples)" ] || fail "a second piece does not go on"
expect 0 "$program" --queries 8000 --seed 3 --resume "$work/pieces"
grep -q '^no violation$' "$work/log" || fail "a finished run does not say its result"

expect 0 "$program" --seed 3 --only 17
grep -q '^answer: gap ' "$work/log" || fail "--only does not show the answer"

expect 2 "$program" --queries 8000 --seed 4 --resume "$work/pieces"
grep -q 'it is of seed 3, not 4' "$work/log" || fail "another seed is not refused: $(cat "$work/log")"
expect 2 "$program" --queries 0
expect 2 "$program" --sharp --resume "$work/sharp"
expect 2 "$program" --querys 100
expect 0 "$program" --help

# When interrupted, it prints its results and saves them.
"$program" --queries 1e12 --seed 3 --resume "$work/stopped" >"$work/log" 2>&1 &
pid=$!
sleep 1
kill -TERM "$pid"
code=0
wait "$pid" || code=$?
[ "$code" -eq 130 ] || { cat "$work/log" >&2; fail "exit code $code instead of 130 when interrupted"; }
[ "$(value stopped samples)" -gt 0 ] || fail "nothing is kept when interrupted"
echo "all passed"
