#!/usr/bin/env bash
# What gnuplot and POV-Ray draw at the end of a run: there where they are installed, told where they are not, and whatever they do
# the results stay. Usage: drawings_test.sh PROGRAM SAMPLES_FOLDER
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
program=$1
samples=$2

# The scene, shorter, with its pictures. $1: the scene, $2: pictures, then sed expressions
scene_with() {
  local name=$1 pictures=$2 && shift 2
  sed "$@" -e '/^\[output\]/,$d' "$samples/scenes/$name.toml" >"$work/scenes/$name.toml"
  printf '\n[output]\npictures = [%s]\n' "$pictures" >>"$work/scenes/$name.toml"
}

brief() { scene_with short "$1" -e 's/^duration = .*/duration = 0.1/'; }

# A program of that name in a folder that is the whole PATH. $1: name, $2: commands
fake() {
  mkdir -p "$work/fakes"
  printf '#!/bin/sh\n%s\n' "$2" >"$work/fakes/$1"
  chmod +x "$work/fakes/$1"
}
with_fakes() { env PATH="$work/fakes" "$program" "$@"; }

results_are_whole() {
  [[ $(wc -l <"$work/out/short/energies.csv") -eq 12 && -s $work/out/short/summary.toml ]] || fail "results are missing"
  [ "$(ls -A "$work/out")" = short ] || fail "left behind: $(ls -A "$work/out")"
}

plots_of_every_table() {
  command -v gnuplot >/dev/null || { echo "no gnuplot: plots are not looked at" >&2; return 0; }
  brief '"plots"'
  scene_with hopper '"plots"' -e 's/^count = .*/count = 20/' -e 's/^opens_at = [^ ]*/opens_at = 0.2/' -e 's/^duration = .*/duration = 0.5/'
  scene_with packing_spheres '"plots"' -e 's/^count = .*/count = 30/' -e 's/^side = [^ ]*/side = 0.04/' -e 's/^duration = [^ ]*/duration = 0.3/'
  local scene table
  for scene in short hopper packing_spheres; do
    # Twice: the second run replaces the plots of the first.
    expect 0 "$program" -q --scene "$work/scenes/$scene.toml" --out "$work/plots"
    expect 0 "$program" -q --scene "$work/scenes/$scene.toml" --out "$work/plots"
    ! grep -q 'Not drawn' "$work/log" || fail "$(cat "$work/log")"
    for table in "$work/plots/$scene"/*.csv; do
      case $(basename "$table") in trajectory.csv | final_state.csv) continue ;; esac  # of grains, not over time
      local plot=${table%.csv}.svg
      [[ "$(tail -c 20 "$plot")" == *"</svg>" ]] || fail "$plot is not whole"
      ! command -v xmllint >/dev/null || xmllint --noout "$plot" || fail "$plot is not XML"
      [ "$(grep -c '<path' "$plot")" -gt 10 ] || fail "$plot is empty"
    done
  done
  printf 'time_s,pressure_Pa,shear_rate_per_s\n0,1,2\n1,2,3\n' >"$work/plots/stress.csv"
  gnuplot -c "$samples/falling_particles/plots/measurement.gp" "$work/plots/stress.csv" "stress, Pa" pressure_Pa >"$work/plots/titles" ||
    fail "measurement.gp fails"
  grep -q '<text>pressure<' "$work/plots/titles" || fail "the key names a raw column: $(grep '<text>p' "$work/plots/titles")"
  [ "$(cd "$work/plots" && echo */*.svg)" = "hopper/discharge.svg hopper/energies.svg hopper/state.svg\
 packing_spheres/compression.svg packing_spheres/energies.svg packing_spheres/state.svg short/energies.svg short/state.svg" ] ||
    fail "wrong plots: $(cd "$work/plots" && echo */*.svg)"
}

without_gnuplot() {
  brief '"plots", "povray"'
  mkdir -p "$work/empty"
  expect 0 env PATH="$work/empty" "$program" -q --scene "$work/scenes/short.toml" --out "$work/out"
  grep -qx 'Not drawn: energies.svg, state.svg; gnuplot is not installed (sudo apt install gnuplot-nox)' "$work/log" ||
    fail "unclear: $(grep 'Not' "$work/log")"
  grep -qx 'Not drawn: still.png; povray is not installed (sudo apt install povray)' "$work/log" || fail "unclear: $(grep 'Not' "$work/log")"
  [ -s "$work/out/short/still.pov" ] || fail "no still.pov"
  results_are_whole
}

a_failing_gnuplot() {
  brief '"plots"'
  fake gnuplot 'echo "<svg>half"; echo "line 3: no ink" >&2; exit 1'
  expect 0 with_fakes -q --scene "$work/scenes/short.toml" --out "$work/out"
  grep -qx 'Not drawn: energies.svg; gnuplot failed: line 3: no ink' "$work/log" || fail "unclear: $(grep 'Not' "$work/log")"
  [ ! -e "$work/out/short/energies.svg" ] || fail "half a plot"
  results_are_whole
  fake gnuplot 'exit 0'
  expect 0 with_fakes -q --scene "$work/scenes/short.toml" --out "$work/out"
  grep -qx 'Not drawn: state.svg; gnuplot failed: it wrote nothing' "$work/log" || fail "unclear: $(grep 'Not' "$work/log")"
  results_are_whole
}

a_still() {
  brief '"povray"'
  fake povray 'echo "$*"'
  expect 0 with_fakes -q --scene "$work/scenes/short.toml" --out "$work/out"
  [ "$(cat "$work/out/short/still.png")" = "+Istill.pov +O- +FN +W900 +H560 +A0.2 -D +WT1" ] || fail "$(cat "$work/out/short/still.png")"
  results_are_whole
  command -v povray >/dev/null || { echo "no povray: no still is rendered" >&2; return 0; }
  expect 0 "$program" -q --scene "$work/scenes/short.toml" --out "$work/out"
  [ "$(od -An -tx1 -j1 -N23 "$work/out/short/still.png" | tr -d ' \n')" = 504e470d0a1a0a0000000d494844520000038400000230 ] ||
    fail "still.png is not a PNG of 900 x 560 pixels"
  local first
  first=$(sha256sum <"$work/out/short/still.png")
  expect 0 "$program" -q --scene "$work/scenes/short.toml" --out "$work/out"
  [ "$(sha256sum <"$work/out/short/still.png")" = "$first" ] || fail "still.png is not the same bytes when it is drawn again"
}

ctrl_c_ends_the_drawing_alone() {
  brief '"plots", "povray"'
  fake gnuplot 'echo "<svg/>"'
  fake povray 'echo $$ >pid; exec /bin/sleep 600'
  # Job control, so that the background process does not ignore SIGINT; the group gets it, as from a terminal.
  set -m
  with_fakes -q --scene "$work/scenes/short.toml" --out "$work/out" >"$work/log" 2>&1 &
  local pid=$! got=0
  set +m
  until [ -s "$work/out/short/pid" ]; do
    kill -0 "$pid" 2>/dev/null || { cat "$work/log" >&2; fail "ended before it was interrupted"; }
    sleep 0.05
  done
  kill -INT -- "-$pid"
  wait "$pid" || got=$?
  [ "$got" -eq 130 ] || fail "exit code $got instead of 130 after Ctrl-C"
  grep -qx 'Not drawn: still.png; stopped by Ctrl-C' "$work/log" || fail "unclear: $(cat "$work/log")"
  ! kill -0 "$(cat "$work/out/short/pid")" 2>/dev/null || fail "povray goes on"
  [ -s "$work/out/short/state.svg" ] || fail "the plots have gone"
  grep -q '^interrupted *= false ' "$work/out/short/summary.toml" || fail "the run was not interrupted"
  results_are_whole
  rm -r "$work/out"  # pid is no file of a run
}

no_pictures_leaves_the_tables() {
  brief '"glb", "plots", "povray"'
  expect 0 "$program" -q --no-pictures --scene "$work/scenes/short.toml" --out "$work/out"
  [ "$(cd "$work/out/short" && echo *)" = "energies.csv final_state.csv state.csv summary.toml trajectory.csv" ] || fail "left: $(ls "$work/out/short")"
}

mkdir "$work/scenes" && cp -r "$samples/data" "$work/data"
plots_of_every_table
without_gnuplot
a_failing_gnuplot
a_still
ctrl_c_ends_the_drawing_alone
no_pictures_leaves_the_tables
echo "all passed"
