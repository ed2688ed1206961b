#!/usr/bin/env bash
# Runs that are killed at random moments, stopped, or out of space, and then resumed: the same bytes as of a run that was left alone.
# Usage: checkpoint_test.sh PROGRAM SAMPLES_FOLDER [KILLS [SEED]]
#   KILLS: of the scene that has most in it (3), and with several one of each of the others; SEED: of the moments
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
program=$1
samples=$2
kills=${3:-3}
seed=${4:-$(date +%s)}
echo "seed $seed"
RANDOM=$seed

mkdir "$work/scenes" "$work/fakes" && cp -r "$samples/data" "$work/data"
# What another program draws takes as long as a shell script.
printf '#!/bin/sh\necho picture\n' >"$work/fakes/povray"
chmod +x "$work/fakes/povray"
PATH=$work/fakes:$PATH

pictures='
[output]
pictures = ["page", "glb", "lammps", "vtk", "povray"]
forces = true
'

# A belt that repeats across its way, with grains of two kinds and many sizes that come and go, a paddle that turns and a piston, and
# five measurements.
busy_scene() {
  sed -e 's/^duration = .*/duration = 0.3/' -e 's/velocity = \[0.4, 0, 0\]/velocity = [1, 0, 0]/;s/rpm = .* }/rpm = 954.9 }/' \
    -e 's/^kg_per_second = .*/kg_per_second = 0.1/' -e '/^# The walls across y/,/^\[\[grain\]\]/{/^\[\[grain\]\]/!d}' \
    -e '/^name = "soybean"$/{n;s/^count = 0$/&\nsize = { distribution = "uniform", unit = "catalogue", smallest = 0.8, largest = 1.2 }/}' \
    -e 's/^until = 3.*/until = 0.25/' -e 's/^corner = \[0.3, 0, 0\].*/corner = [0.12, 0, 0.1]/' "$samples/scenes/feeder.toml"
  cat <<'END'
[periodic]
y = [0, 0.06]
[[part]]
name = "paddle"
shape = "box"
size = [0.04, 0.2, 0.004]
position = [0.15, 0.03, 0.16]
[[part.motion]]
kind = "rotation"
axis = [0, 1, 0]
point = [0.15, 0.03, 0.16]
rpm = 60
[[part]]
name = "piston"
shape = "box"
size = [0.05, 0.2, 0.02]
position = [0.4, 0.03, 0.09]
[part.drive]
axis = [0, 0, -1]
force = 1
mass = 0.1
from = 0.1
[[measurement]]
kind = "contact_forces"
interval = 0.02
[[measurement]]
kind = "grid"
lower = [0, 0, 0.1]
upper = [0.3, 0.06, 0.2]
cells = [6, 1, 2]
interval = 0.01
[[measurement]]
kind = "part_force"
name = "paddle"
surfaces = ["paddle"]
interval = 0.001
[[measurement]]
kind = "stress"
lower = [0, 0, 0.1]
upper = [0.3, 0.06, 0.2]
interval = 0.01
[[measurement]]
kind = "coordination"
interval = 0.01
END
  echo "$pictures"
}

packing_scene() {
  sed -e 's/^duration = .*/duration = 0.4/' -e 's/^count = .*/count = 150/' -e 's/^side = .*/side = 0.08/' -e 's/^frame = .*/frame = 0.02/' \
    "$samples/scenes/packing_superballs.toml"
  echo "$pictures"
}

hopper_scene() {
  sed -e 's/^duration = .*/duration = 0.4/' -e 's/^opens_at = .*/opens_at = 0.15/' -e 's/^count = .*/count = 100/' \
    -e 's/^frame = .*/frame = 0.02/' "$samples/scenes/hopper.toml"
  printf '[[measurement]]\nkind = "part_force"\nname = "walls"\ninterval = 0.01\n%s\n' "$pictures"
}

agglomerate_scene() {
  sed -e 's/^velocity = \[0, 0, 1\].*/velocity = [0, 0, 4]/' "$samples/scenes/agglomerate.toml"
  echo "$pictures"
}

# What a run leaves, but for what it took: [cost] of the summary. $1: the folder
results() {
  (cd "$1" && find . -type f | sort | while read -r file; do
    case $file in
      ./summary.toml) echo "$(sed '/^\[cost\]/,$d' "$file" | sha256sum) $file" ;;
      *) sha256sum "$file" ;;
    esac
  done)
}

# Starts the program itself, as the shell's last child. $1: the folder, then further options
start() {
  "$program" -q -t $((RANDOM % 2 + 1)) --scene "$work/scenes/$scene.toml" --out "$1" --checkpoint-every "$every" "${@:2}" >"$work/log" 2>&1 &
}
run() { start "$@" && wait $!; }

# A run of the scene $1 that nobody kills, with a checkpoint every $2 steps.
left_alone() {
  scene=$1 every=$2
  "${scene}_scene" >"$work/scenes/$scene.toml"
  local start=$EPOCHREALTIME
  run "$work/whole" || fail "$scene: $(cat "$work/log")"
  milliseconds=$(((${EPOCHREALTIME/./} - ${start/./}) / 1000))
  results "$work/whole/$scene" >"$work/expected"
  [ "$(wc -l <"$work/expected")" -gt 10 ] || fail "$scene leaves few files"
}

same_results() {
  results "$work/out/$scene" | diff "$work/expected" - >"$work/difference" || fail "$scene, $1: $(cat "$work/difference")"
  [ "$(echo "$work/out"/*)" = "$work/out/$scene" ] || fail "left behind: $(echo "$work/out"/*)"
}

# Kills a run once or several times, each at a moment at random, and lets it come to its end.
killed() {
  rm -rf "$work/out"
  local hits=0 moments="" moment
  for _ in $(seq $((RANDOM % 3 + 1))); do
    moment=$((RANDOM % milliseconds))
    start "$work/out" --resume
    sleep "$((moment / 1000)).$(printf %03d $((moment % 1000)))"
    kill -9 $! 2>/dev/null || true
    wait $! 2>/dev/null || hits=$((hits + 1))
    moments="$moments $moment"
  done
  run "$work/out" --resume || fail "$scene, killed after$moments ms: $(cat "$work/log")"
  same_results "killed after$moments ms"
  echo "$scene: killed after$moments ms ($hits of them before the end of $milliseconds ms): the same"
}

# A signal that can be caught ends the run at its next checkpoint.
stopped() {
  local got=0
  rm -rf "$work/out"
  start "$work/out" --resume
  while [ ! -e "$work/out/$scene.unfinished-1/energies.csv" ]; do sleep 0.02; done
  kill -s "$1" $!
  wait $! || got=$?
  [ $got -eq 130 ] || fail "$scene, $1: exit code $got: $(cat "$work/log")"
  grep -q "^Stopped after step [0-9]*0 of [0-9]*: --resume goes on from there" "$work/log" || fail "unclear: $(cat "$work/log")"
  run "$work/out" --resume || fail "$scene, after $1: $(cat "$work/log")"
  same_results "$1"
}

# No file may be larger than what a run writes, less something: the run ends with the reason, and goes on when there is space.
out_of_space() {
  local got=0 size
  rm -rf "$work/out"
  for size in 100000 200000 400000 800000; do
    got=0
    (ulimit -c 0 && prlimit --fsize=$size "$program" -q --scene "$work/scenes/$scene.toml" --out "$work/out" --checkpoint-every "$every" \
      --resume) >/dev/null 2>"$work/log" || got=$?
    [ $got -eq 1 ] || fail "$scene, $size bytes: exit code $got: $(cat "$work/log")"
    grep -q "^falling_particles: cannot write .*: File too large" "$work/log" || fail "unclear: $(cat "$work/log")"
  done
  grep -q "^The last checkpoint is in .*: --resume goes on from there.$" "$work/log" || fail "unclear: $(cat "$work/log")"
  run "$work/out" --resume || fail "$scene, with space: $(cat "$work/log")"
  same_results "out of space"
}

# A checkpoint of another scene, or one that is torn, is refused and stays.
refused() {
  local checkpoint=$work/out/$scene.unfinished-1/checkpoint size
  rm -rf "$work/out"
  start "$work/out"
  while [ ! -e "$checkpoint" ]; do sleep 0.02; done
  kill -9 $!
  wait $! 2>/dev/null || true
  cp "$work/scenes/$scene.toml" "$work/kept"
  sed -i 's/^seed = .*/seed = 99/' "$work/scenes/$scene.toml"
  expect 2 "$program" -q --scene "$work/scenes/$scene.toml" --out "$work/out" --resume
  grep -q "is of another scene: the text of $scene.toml was another one" "$work/log" || fail "unclear: $(cat "$work/log")"
  cp "$work/kept" "$work/scenes/$scene.toml"
  expect 2 "$program" -q --scene "$work/scenes/$scene.toml" --out "$work/out" --resume --checkpoint-every $((every + 1))
  grep -q "is of a run with --checkpoint-every $every; allowed: " "$work/log" || fail "unclear: $(cat "$work/log")"
  size=$(stat -c %s "$checkpoint")
  cp "$checkpoint" "$work/whole_checkpoint"
  truncate -s $((size - 1)) "$checkpoint"
  expect 2 "$program" -q --scene "$work/scenes/$scene.toml" --out "$work/out" --resume
  grep -q "is torn: " "$work/log" || fail "unclear: $(cat "$work/log")"
  cp "$work/whole_checkpoint" "$checkpoint"
  expect 0 "$program" -q --scene "$work/scenes/$scene.toml" --out "$work/out" --resume  # every as before
  same_results "refused before"
}

# A table that was changed since the checkpoint is refused, without the advice to resume; a user's file in the folder is none.
damaged() {
  local unfinished=$work/out/$scene.unfinished-1
  rm -rf "$work/out"
  start "$work/out"
  while [ ! -e "$unfinished/checkpoint" ]; do sleep 0.02; done
  kill -9 $!
  wait $! 2>/dev/null || true
  touch "$unfinished/.energies.csv.swp"
  cp "$unfinished/energies.csv" "$work/whole_table"
  for damage in 'truncate -s 10' 'sed -i 1s/kinetic/kinetik/' rm; do
    $damage "$unfinished/energies.csv"
    expect 2 "$program" -q --scene "$work/scenes/$scene.toml" --out "$work/out" --resume
    grep -q "energies.csv\" .*; without --resume the run starts anew" "$work/log" || fail "unclear: $(cat "$work/log")"
    ! grep -q "goes on from there" "$work/log" || fail "the advice leads nowhere: $(cat "$work/log")"
    cp "$work/whole_table" "$unfinished/energies.csv"
  done
  run "$work/out" --resume || fail "$scene, with a foreign file: $(cat "$work/log")"
  rm "$work/out/$scene/.energies.csv.swp"
  same_results "a foreign file in its folder"
}

left_alone busy 40
for _ in $(seq "$kills"); do killed; done
stopped TERM
stopped INT
out_of_space
refused
damaged
if [ "$kills" -gt 1 ]; then
  left_alone hopper 70
  killed
  left_alone packing 30
  killed
  left_alone agglomerate 60
  killed
fi
echo "all passed"
