#!/usr/bin/env bash
# The program from outside: the same result twice, exit codes, nothing left behind after bad input, Ctrl-C.
# Usage: falling_particles_cli_test.sh PROGRAM SAMPLES_FOLDER
set -euo pipefail
program=$1
samples=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "FAILED: $*" >&2; exit 1; }

# expect CODE command...: runs it with stdout and stderr into $work/log
expect() {
  local code=$1 got=0
  shift
  "$@" >"$work/log" 2>&1 || got=$?
  [ "$got" -eq "$code" ] || { cat "$work/log" >&2; fail "exit code $got instead of $code: $*"; }
}

# summary.toml up to [cost], which holds what depends on the machine
end_state() { sed '/^\[cost\]/,$d' "$1/short/summary.toml"; }

same_seed_same_result() {
  expect 0 "$program" --scene "$samples/scenes/short.toml" --out "$work/first"
  grep -q '^100 %' "$work/log" || fail "no plain progress lines when redirected"
  ! grep -q $'\r' "$work/log" || fail "a progress bar where there is no terminal"
  grep -q '^volume_fraction ' "$work/log" || fail "the summary is not printed"
  # With a longer environment all addresses move: nothing may depend on them.
  expect 0 env SHIFT_THE_STACK="$(printf '%2000s' '')" "$program" -q --scene "$samples/scenes/short.toml" --out "$work/second"
  for file in trajectory.csv energies.csv; do
    cmp "$work/first/short/$file" "$work/second/short/$file" || fail "$file differs in the second run"
  done
  [ "$(end_state "$work/first")" = "$(end_state "$work/second")" ] || fail "summary.toml differs in the second run"
  grep -q '^bodies_outside *= 0 ' "$work/first/short/summary.toml" || fail "grains outside the box"
  grep -q '^settled *= true ' "$work/first/short/summary.toml" || fail "not settled"
}

other_seed_other_result() {
  mkdir -p "$work/scenes" && cp -r "$samples/data" "$work/data"
  sed 's/^seed = .*/seed = 4711/' "$samples/scenes/short.toml" >"$work/scenes/short.toml"
  expect 0 "$program" -q --scene "$work/scenes/short.toml" --out "$work/third"
  ! cmp -s "$work/first/short/trajectory.csv" "$work/third/short/trajectory.csv" || fail "the seed has no effect"
}

bad_input_leaves_nothing() {
  sed 's/^step = .*/step = -1/' "$samples/scenes/short.toml" >"$work/scenes/bad.toml"
  expect 2 "$program" --scene "$work/scenes/bad.toml" --out "$work/bad"
  [ "$(wc -l <"$work/log")" -eq 1 ] || fail "more than one line about one mistake"
  grep -q 'bad.toml:[0-9]*: time.step is -1; allowed: ' "$work/log" || fail "unclear message: $(cat "$work/log")"
  expect 2 "$program" --scene "$work/scenes/missing.toml" --out "$work/bad"
  expect 2 "$program" --out "$work/bad"
  expect 2 "$program" --scene "$work/scenes/short.toml" --out "$work/bad" --speed 3
  [ ! -e "$work/bad" ] || fail "an output folder after bad input"
  expect 0 "$program" --help
}

ctrl_c_writes_what_there_is() {
  sed 's/^duration = .*/duration = 3600/' "$samples/scenes/short.toml" >"$work/scenes/long.toml"
  # Job control, so that the background process does not ignore SIGINT.
  set -m
  "$program" --scene "$work/scenes/long.toml" --out "$work/stopped" >"$work/log" 2>&1 &
  local pid=$! got=0
  set +m
  until compgen -G "$work/stopped/.long.unfinished-*/energies.csv" >/dev/null; do
    kill -0 "$pid" 2>/dev/null || { cat "$work/log" >&2; fail "ended before it was interrupted"; }
    sleep 0.05
  done
  sleep 0.2
  kill -INT "$pid"
  wait "$pid" || got=$?
  [ "$got" -eq 130 ] || fail "exit code $got instead of 130 after Ctrl-C"
  grep -q 'Interrupted after step' "$work/log" || fail "does not say that it was interrupted"
  grep -q '^interrupted *= true ' "$work/stopped/long/summary.toml" || fail "the summary does not say so"
  [ "$(wc -l <"$work/stopped/long/energies.csv")" -ge 2 ] || fail "no frames"
  [ -z "$(find "$work/stopped" -name '.*' -mindepth 1)" ] || fail "unfinished folder left behind"
}

same_seed_same_result
other_seed_other_result
bad_input_leaves_nothing
ctrl_c_writes_what_there_is
echo "all passed"
