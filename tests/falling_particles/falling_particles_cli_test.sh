#!/usr/bin/env bash
# The program from outside: the same result twice, containers, exit codes, nothing left behind after bad input, Ctrl-C.
# Usage: falling_particles_cli_test.sh PROGRAM SAMPLES_FOLDER [populations]
#   populations: only what takes many grains
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
program=$1
samples=$2

# summary.toml up to [cost], which holds what depends on the machine
end_state() { sed '/^\[cost\]/,$d' "$1/short/summary.toml"; }

same_seed_same_result() {
  expect 0 "$program" --scene "$samples/scenes/short.toml" --out "$work/first"
  grep -q '^100 %' "$work/log" || fail "no plain progress lines when redirected"
  ! grep -q $'\r' "$work/log" || fail "a progress bar where there is no terminal"
  grep -q '^volume_fraction ' "$work/log" || fail "the summary is not printed"
  # With a longer environment all addresses move: nothing may depend on them.
  expect 0 env SHIFT_THE_STACK="$(printf '%2000s' '')" "$program" -q --scene "$samples/scenes/short.toml" --out "$work/second"
  for file in trajectory.csv energies.csv state.csv; do
    cmp "$work/first/short/$file" "$work/second/short/$file" || fail "$file differs in the second run"
  done
  [ "$(end_state "$work/first")" = "$(end_state "$work/second")" ] || fail "summary.toml differs in the second run"
  grep -q '^bodies_outside *= 0 ' "$work/first/short/summary.toml" || fail "grains outside the box"
  grep -q '^settled *= true ' "$work/first/short/summary.toml" || fail "not settled"
  state_is_as_summed_up "$work/first/short"
}

# --tables prints the tables of a run and their first lines. $1: the scene, $2: the results
tables_are_told() {
  "$program" --tables "$1" >"$work/tables" || fail "--tables fails"
  (cd "$2" && for table in *.csv measurements/*.csv; do
    echo "\"$table\" = [\"$(head -n 1 "$table" | sed 's/,/", "/g')\"]"
  done) | sort | diff - <(sort "$work/tables") || fail "--tables prints others than a run writes"
}

# Measurements change no grain's way, and are the same with any number of threads.
measurements_are_written() {
  { cat "$samples/scenes/short.toml"
    sed -n '/^\[\[measurement\]\]/,$p' "$samples/scenes/silo.toml" | sed -e 's/^from = .*//' -e 's/^interval = .*/interval = 0.05/'
  } >"$work/scenes/short.toml"
  for threads in 1 2; do expect 0 "$program" -q -t $threads --scene "$work/scenes/short.toml" --out "$work/measured$threads"; done
  for file in trajectory.csv energies.csv state.csv; do
    cmp "$work/first/short/$file" "$work/measured1/short/$file" || fail "$file differs where there are measurements"
  done
  diff -r "$work/measured1/short/measurements" "$work/measured2/short/measurements" || fail "measurements differ with two threads"
  local table
  for table in floor walls stress coordination fabric nematic_order contact_forces; do
    [ "$(wc -l <"$work/measured1/short/measurements/$table.csv")" -gt 10 ] || fail "$table.csv has less than a line a sample"
    grep -q "^measurement.$table.seconds " "$work/measured1/short/summary.toml" || fail "the cost of $table is not told"
  done
  tables_are_told "$work/scenes/short.toml" "$work/measured1/short"
  expect 0 "$program" -q --scene "$samples/scenes/short.toml" --out "$work/measured1" --set time.duration=0.01
  [ ! -e "$work/measured1/short/measurements" ] || fail "an earlier run's measurements stay"
  expect 0 "$program" --list
  for name in friction stress part_force surface; do grep -q "[[\"]$name[]\"]" "$work/log" || fail "--list does not name $name"; done
}

# A run goes on from the end of another one with other parameters. The same state gives the same files.
a_state_is_a_start() {
  local start=(-q --scene "$samples/scenes/short.toml" --set time.duration=0.05 --set time.frame=0.05 --set friction.coefficient=0.2)
  start+=(--set "start.file=\"$work/first/short/final_state.csv\"")
  for threads in 1 2; do
    expect 0 "$program" "${start[@]}" -t $threads --out "$work/from_state$threads"
  done
  for file in trajectory.csv energies.csv state.csv final_state.csv; do
    cmp "$work/from_state1/short/$file" "$work/from_state2/short/$file" || fail "$file differs with two threads"
  done
  # The first frame is the last one of the other run.
  diff <(grep '^0\.5,' "$work/first/short/trajectory.csv" | cut -d, -f2-6) <(grep '^0,' "$work/from_state1/short/trajectory.csv" | cut -d, -f2-6) ||
    fail "the grains start elsewhere"
  sed 's/,mm_mini,/,mm_maxi,/' "$work/first/short/final_state.csv" >"$work/state.csv"
  for option in --check --scene; do
    expect 2 "$program" $option "$samples/scenes/short.toml" --set "start.file=\"$work/state.csv\""
    grep -q 'state.csv:[0-9]*: grain is "mm_maxi"; did you mean "mm_mini"?; allowed' "$work/log" || fail "unclear message: $(cat "$work/log")"
  done
}

# The page is what --list prints.
the_page_lists_everything() {
  "$program" --list >"$work/list" || fail "--list fails"
  sed -n '/^```text$/,/^```$/{/^```/!p}' "$samples/falling_particles/scene_files.md" | diff - "$work/list" ||
    fail "scene_files.md is not what --list prints"
  local table
  for table in trajectory energies state grains parts feeders; do grep -q "^$table.csv$" "$work/list" || fail "no $table.csv"; done
}

# What a scene would do, and what it may name, is told without a run.
scenes_are_checked() {
  (cd "$work" && expect 0 "$program" --check "$samples/scenes/short.toml" && [ ! -e out ]) || fail "--check has left something"
  local line
  for line in 'steps *1000 of 5e-04 s, 51 frames' 'grains *60 at the start: ' 'effects *friction: ' 'memory *[0-9.]* MB' 'disk *[0-9.]* kB' \
    'time *about [0-9.]* s of processor time'; do
    grep -q "^$line" "$work/log" || fail "--check does not say $line: $(cat "$work/log")"
  done
  sed 's/^step = .*/step = -1/' "$samples/scenes/short.toml" >"$work/scenes/bad.toml"
  expect 2 "$program" --check --scene "$samples/scenes/short.toml"
  grep -q -e '--check: it takes the scene file itself' "$work/log" || fail "unclear message: $(cat "$work/log")"
  expect 2 "$program" --check "$work/scenes/bad.toml"
  grep -q 'bad.toml:[0-9]*: time.step is -1; allowed: ' "$work/log" || fail "unclear message: $(cat "$work/log")"
  expect 0 "$program" --list
  for line in '\[\[part\]\] shape = "mesh"' '\[\[part.motion\]\] kind = "conveyor"' '\[part.drive\]' '\[\[feeder\]\]' '\[\[sink\]\]'; do
    grep -q "^$line" "$work/log" || fail "--list does not name $line"
  done
}

other_seed_other_result() {
  sed -e 's/^seed = .*/seed = 4711/' -e 's/^duration = .*/duration = 0.1/' "$samples/scenes/short.toml" >"$work/scenes/short.toml"
  expect 0 "$program" -q --scene "$work/scenes/short.toml" --out "$work/third"
  local size
  size=$(stat -c %s "$work/third/short/trajectory.csv")
  ! cmp -s -n "$size" "$work/first/short/trajectory.csv" "$work/third/short/trajectory.csv" || fail "the seed has no effect"
}

# What an option sets in place of a scene's value is as if the scene had it, and the summary says so.
values_are_set() {
  expect 0 "$program" -q --scene "$samples/scenes/short.toml" --out "$work/set" --set seed=4711 --set time.duration=0.1 --set 'output.pictures=[]'
  cmp "$work/third/short/trajectory.csv" "$work/set/short/trajectory.csv" || fail "--set seed is not the seed"
  [ ! -e "$work/set/short/view.html" ] || fail "--set output.pictures has no effect"
  grep -qF '= ["seed=4711", "time.duration=0.1", "output.pictures=[]"]' "$work/set/short/summary.toml" || fail "the summary does not say what was set"
  ! grep -q '^set ' "$work/third/short/summary.toml" || fail "the summary says that something was set"
  expect 2 "$program" --scene "$samples/scenes/short.toml" --out "$work/bad" --set time.step=-1
  grep -q '^--set time.step=-1: time.step is -1; allowed: ' "$work/log" || fail "unclear message: $(cat "$work/log")"
  [ ! -e "$work/bad" ] || fail "an output folder after bad input"
}

bad_input_leaves_nothing() {
  sed 's/^step = .*/step = -1/' "$samples/scenes/short.toml" >"$work/scenes/bad.toml"
  expect 2 "$program" --scene "$work/scenes/bad.toml" --out "$work/bad"
  [ "$(wc -l <"$work/log")" -eq 1 ] || fail "more than one line about one mistake"
  grep -q 'bad.toml:[0-9]*: time.step is -1; allowed: ' "$work/log" || fail "unclear message: $(cat "$work/log")"
  expect 2 "$program" --scene "$work/scenes/missing.toml" --out "$work/bad"
  expect 2 "$program" --out "$work/bad"
  expect 2 "$program" --scene "$work/scenes/short.toml" --out "$work/bad" --speed 3
  expect 2 "$program" --scen "$work/scenes/short.toml" --out "$work/bad"
  grep -q -- 'not expected: --scen$' "$work/log" || fail "the misspelt option is not named: $(cat "$work/log")"
  expect 2 "$program" --out "$work/bad"
  grep -q -- '--scene is required' "$work/log" || fail "the missing option is not named: $(cat "$work/log")"
  [ ! -e "$work/bad" ] || fail "an output folder after bad input"
  expect 0 "$program" --help
}

# The scene with fewer grains and less time. $1: name, then sed expressions
shortened() {
  local name=$1 && shift
  sed "$@" -e 's/^frame = .*/frame = 0.01/' "$samples/scenes/$name.toml" >"$work/scenes/$name.toml"
}

# A number of $work/containers/$1/summary.toml. $2: its key
value() { sed -n "s/^$2 *= *\([^ ]*\).*/\1/p" "$work/containers/$1/summary.toml"; }

other_containers() {
  shortened hopper -e 's/^count = .*/count = 30/' -e 's/^opens_at = [^ ]*/opens_at = 0.3/' -e 's/^duration = .*/duration = 0.8/'
  expect 0 "$program" -q --check-leaks --scene "$work/scenes/hopper.toml" --out "$work/containers"
  [ "$(value hopper container)" = '"hopper"' ] || fail "the summary does not name the hopper"
  [ "$(value hopper bodies_leaked)" = 0 ] || fail "grains leaked out of the hopper"
  [ "$(value hopper discharged_grains)" = 60 ] || fail "the hopper did not run empty"
  awk "BEGIN { exit !($(value hopper mass_flow) > 0 && $(value hopper beverloo) > 0) }" || fail "no mass flow"
  local csv=$work/containers/hopper/discharge.csv
  [ "$(wc -l <"$csv")" -eq 82 ] || fail "discharge.csv is not a head and 81 frames"
  [ "$(tail -1 "$csv" | cut -d, -f3)" = 60 ] || fail "discharge.csv does not end with all grains"
  awk -F, 'NR > 1 { if ($2 < mass || $1 < 0.3 && $3 > 0) exit 1; mass = $2 }' "$csv" || fail "discharge.csv falls, or starts early"

  shortened terrain -e 's/^count = .*/count = 4/' -e 's/^duration = .*/duration = 0.4/'
  expect 0 "$program" -q --check-leaks --scene "$work/scenes/terrain.toml" --out "$work/containers"
  [ "$(value terrain bodies_leaked)" = 0 ] || fail "grains leaked through the terrain"
  [ ! -e "$work/containers/terrain/discharge.csv" ] || fail "discharge.csv without a hopper"

  shortened heap -e 's/^count = .*/count = 60/' -e 's/^opens_at = .*/opens_at = 0.1/' -e 's/^duration = .*/duration = 0.6/'
  expect 0 "$program" -q --check-leaks --scene "$work/scenes/heap.toml" --out "$work/containers"
  [ "$(value heap heap_grains)" -gt 30 ] || fail "the dish holds only $(value heap heap_grains) of 60 grains"

  shortened packing_spheres -e 's/^count = .*/count = 30/' -e 's/^side = [^ ]*/side = 0.04/' -e 's/^duration = [^ ]*/duration = 1/'
  expect 0 "$program" -q --check-leaks --scene "$work/scenes/packing_spheres.toml" --out "$work/containers"
  awk "BEGIN { exit !($(value packing_spheres volume_fraction_at_contact) > 0.5) }" || fail "not compressed"
  csv=$work/containers/packing_spheres/compression.csv
  [ "$(wc -l <"$csv")" -eq 101 ] || fail "compression.csv is not a head and 100 frames"
  awk -F, -v fraction="$(value packing_spheres volume_fraction)" -v side="$(value packing_spheres cell_side)" '
    function is_near(a, b) { return (a - b) ^ 2 < 1e-10 * b ^ 2 }
    NR == 2 && !($3 < 0.5) { exit 1 } END { exit !(is_near($2, side) && is_near($3, fraction)) }' "$csv" ||
    fail "compression.csv does not end as the summary does"
}

# Grains come and go, the sums balance, and the files are the same with any number of threads.
feeders_and_sinks() {
  shortened feeder -e 's/^duration = .*/duration = 1.2/'
  for threads in 1 2; do
    expect 0 "$program" -q -t $threads --check-leaks --scene "$work/scenes/feeder.toml" --out "$work/fed$threads"
  done
  for file in trajectory.csv energies.csv state.csv feeders.csv sinks.csv scene.glb; do
    cmp "$work/fed1/feeder/$file" "$work/fed2/feeder/$file" || fail "$file differs with two threads"
  done
  awk -F'[ =]+' '/^(at_start|fed|taken|present)\.(grains|mass) / { sum[$1] = $2 }
    END {
      mass = sum["fed.mass"] + sum["at_start.mass"] - sum["taken.mass"] - sum["present.mass"]
      exit !(sum["taken.grains"] > 0 && mass ^ 2 < 1e-12 &&
             sum["fed.grains"] + sum["at_start.grains"] == sum["taken.grains"] + sum["present.grains"])
    }' "$work/fed1/feeder/summary.toml" || fail "the sums of [population] do not balance"
  [ "$(tail -2 "$work/fed1/feeder/feeders.csv" | awk -F, '{ sum += $5 } END { print (sum > 0.0235 && sum < 0.0241) }')" = 1 ] ||
    fail "not 0.02 kg/s in 1.2 s: $(tail -2 "$work/fed1/feeder/feeders.csv")"
  local present
  present=$(sed -n 's/^present.grains *= \([0-9]*\).*/\1/p' "$work/fed1/feeder/summary.toml")
  [ "$(grep -c '^1\.2,' "$work/fed1/feeder/trajectory.csv")" = "$present" ] || fail "the last frame has not the $present grains"

  sed -e 's/^kg_per_second = .*/kg_per_second = 5/' -e 's/^until = .*/patience = 0.1/' "$samples/scenes/feeder.toml" \
    >"$work/scenes/greedy.toml"
  expect 1 "$program" -q --scene "$work/scenes/greedy.toml" --out "$work/greedy"
  grep -q 'feeder "spout" has been behind its rate of 5 kg/s for 0.1[0-9]* s, .*allowed:' "$work/log" ||
    fail "unclear message: $(cat "$work/log")"

  shortened drum_periodic -e 's/^count = .*/count = 80/' -e 's/^turns_at = .*/turns_at = 0.2/' -e 's/^duration = .*/duration = 0.6/'
  expect 0 "$program" -q --check-leaks --scene "$work/scenes/drum_periodic.toml" --out "$work/containers"
}

names_with_quotes() {
  local name='say "grains" \ 1'
  sed 's/^duration = .*/duration = 0.01/' "$samples/scenes/short.toml" >"$work/scenes/$name.toml"
  expect 0 "$program" -q --scene "$work/scenes/$name.toml" --out "$work/names"
  grep -qF '= "say \"grains\" \\ 1"' "$work/names/$name/summary.toml" ||
    fail "not a TOML string: $(grep '^scene' "$work/names/$name/summary.toml")"
}

# state.csv ends as the summary says. $1: the folder
state_is_as_summed_up() {
  awk -F, -v summary="$1/summary.toml" '
    function is_near(a, b) { return (a - b) ^ 2 <= 1e-10 * b ^ 2 }
    function value(key, line, words) {
      while ((getline line < summary) > 0) if (split(line, words, / *[= ] */) && words[1] == key) break
      close(summary)
      return words[2]
    }
    NR == 1 { for (i = 1; i <= NF; ++i) column[$i] = i }
    END {
      if (!is_near($column["deepest_contact_of_all_steps_m"], value("deepest_contact"))) exit 1
      if (!is_near($column["kinetic_height_m"], value("kinetic_height"))) exit 1
      if (!is_near($column["largest_kinetic_energy_J"], value("largest_kinetic_energy"))) exit 1
      if (!is_near($column["energy_lost_J"], value("energy_lost"))) exit 1
      if (!is_near($column["energy_gained_J"], value("energy_gained"))) exit 1
      if ($column["bodies_leaked"] != value("bodies_leaked")) exit 1
    }' "$1/state.csv" || fail "$1/state.csv does not end as the summary does"
}

leaks_are_told() {
  # A step so long that what falls passes the floor within one.
  sed -e 's/^step = .*/step = 0.15/' -e 's/^frame = .*/frame = 0.15/' "$samples/scenes/short.toml" >"$work/scenes/leaky.toml"
  expect 3 "$program" -q --check-leaks --scene "$work/scenes/leaky.toml" --out "$work/leaky"
  grep -q '^Leak: [0-9]* of 60 grains; the first: grain [0-9]* (.*) left the container at t = ' "$work/log" || fail "leaks are not told"
  ! grep -q '^bodies_leaked *= 0 ' "$work/leaky/leaky/summary.toml" || fail "the summary does not count the leaks"
  state_is_as_summed_up "$work/leaky/leaky"
  expect 0 "$program" -q --scene "$work/scenes/leaky.toml" --out "$work/leaky"
}

# With a limit of memory.
many_grains_are_refused_or_run() {
  limited() { (ulimit -v 1600000 && "$@"); }
  limited "$program" --help >/dev/null 2>&1 || return 0  # sanitizers take more for themselves
  sed -e 's/^total = .*/total = 140000/' -e 's/^duration = .*/duration = 0.001/' -e 's/^frame = .*/frame = 0.001/' \
    "$samples/scenes/short.toml" >"$work/scenes/many.toml"
  expect 2 limited "$program" -q --scene "$work/scenes/many.toml" --out "$work/many"
  grep -q 'many.toml:[0-9]*: the scene has 140000 grains, .* allowed with 1.6 GB: up to 7[0-9]* grains' "$work/log" ||
    fail "unclear message: $(cat "$work/log")"
  [ ! -e "$work/many" ] || fail "an output folder after bad input"
  sed -i 's/^total = .*/total = 70000/' "$work/scenes/many.toml"
  expect 0 limited "$program" -q --scene "$work/scenes/many.toml" --out "$work/many"
  grep -q '^sweep_axis *= "z" ' "$work/many/many/summary.toml" || fail "the sweep is not along the tower of grains"
}

stdout_is_checked() {
  sed 's/^duration = .*/duration = 0.01/' "$samples/scenes/short.toml" >"$work/scenes/brief.toml"
  local got command
  for command in '>/dev/full' '>&-'; do
    got=0
    eval '"$program" -q "$work/scenes/brief.toml" --out "$work/stdout" 2>"$work/log"' "$command" || got=$?
    [ "$got" -eq 1 ] || fail "exit code $got with stdout $command"
    grep -q 'cannot write to stdout' "$work/log" || fail "does not say what failed with stdout $command"
    ! grep -q '^\[' "$work/stdout/brief/trajectory.csv" || fail "the summary went into the trajectory"
    [ -s "$work/stdout/brief/summary.toml" ] || fail "no results with stdout $command"
  done
}

# Starts a run of an hour in the background, sets $pid and returns when it has written frames. $1: name of the scene
start_long_run() {
  sed 's/^duration = .*/duration = 3600/' "$samples/scenes/short.toml" >"$work/scenes/$1.toml"
  # Job control, so that the background process does not ignore SIGINT.
  set -m
  "$program" --scene "$work/scenes/$1.toml" --out "$work/stopped" >"$work/log" 2>&1 &
  pid=$!
  set +m
  # The file that this process writes: another run's, or a killed one's, may lie beside it.
  local energies=
  until energies=$(readlink "/proc/$pid/fd/"* 2>/dev/null | grep '/energies.csv$') && [ "$(wc -l <"$energies")" -ge 3 ]; do
    kill -0 "$pid" 2>/dev/null || { cat "$work/log" >&2; fail "ended before it was interrupted"; }
    sleep 0.05
  done
}

ctrl_c_writes_what_there_is() {
  local pid got=0
  start_long_run long
  kill -INT "$pid"
  wait "$pid" || got=$?
  [ "$got" -eq 130 ] || fail "exit code $got instead of 130 after Ctrl-C"
  grep -q 'Interrupted after step' "$work/log" || fail "does not say that it was interrupted"
  grep -q '^interrupted *= true ' "$work/stopped/long/summary.toml" || fail "the summary does not say so"
  [ "$(wc -l <"$work/stopped/long/energies.csv")" -ge 2 ] || fail "no frames"
  [ "$(ls -A "$work/stopped")" = long ] || fail "left behind: $(ls -A "$work/stopped")"
}

a_killed_run_leaves_whole_frames_until_the_next() {
  local pid left=$work/stopped/killed.unfinished-1
  start_long_run killed
  kill -KILL "$pid"
  wait "$pid" 2>/dev/null || true
  [ "$(ls "$left" | tr '\n' ' ')" = "UNFINISHED energies.csv final_state.csv state.csv trajectory.csv " ] || fail "left behind: $(ls "$left")"
  [ "$(tail -c 1 "$left/energies.csv" | wc -l)" -eq 1 ] || fail "energies.csv ends within a line"
  [ "$(wc -l <"$left/energies.csv")" -ge 3 ] || fail "energies.csv holds no frames"
  awk -F, 'NF != 10 { exit 1 } END { exit (NR - 1) % 60 != 0 || NR < 120 }' "$left/trajectory.csv" ||
    fail "trajectory.csv does not hold whole frames"

  # The next run takes it away, but neither a run that is on its way nor what no run has written.
  mkdir "$work/stopped/killed.unfinished-notes" && echo mine >"$work/stopped/killed.unfinished-notes/energies.csv"
  start_long_run killed
  local living=$pid
  sed -i 's/^duration = .*/duration = 0.01/' "$work/scenes/killed.toml"
  expect 0 "$program" -q --scene "$work/scenes/killed.toml" --out "$work/stopped"
  kill -0 "$living" || fail "the other run has ended"
  [ "$(echo "$work/stopped"/killed*)" = "$work/stopped/killed $left $work/stopped/killed.unfinished-notes" ] ||
    fail "wrong folders: $(ls "$work/stopped")"
  [ "$(wc -l <"$left/energies.csv")" -ge 3 ] || fail "the run on its way has lost its files"
  kill -KILL "$living"
  wait "$living" 2>/dev/null || true
  expect 0 "$program" -q --scene "$work/scenes/killed.toml" --out "$work/stopped"
  [ ! -e "$left" ] || fail "the leftovers of the killed run are still there"
  [ "$(cat "$work/stopped/killed.unfinished-notes/energies.csv")" = mine ] || fail "a folder of the user's was deleted"
}

mkdir "$work/scenes" && cp -r "$samples/data" "$work/data"
if [ "${3:-}" = populations ]; then
  other_containers
  feeders_and_sinks
  many_grains_are_refused_or_run
  echo "all passed"
  exit
fi
same_seed_same_result
measurements_are_written
a_state_is_a_start
the_page_lists_everything
scenes_are_checked
other_seed_other_result
values_are_set
bad_input_leaves_nothing
names_with_quotes
leaks_are_told
stdout_is_checked
ctrl_c_writes_what_there_is
a_killed_run_leaves_whole_frames_until_the_next
echo "all passed"
