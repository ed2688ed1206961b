#!/usr/bin/env bash
# samples/explain_pair from outside: its three sources of pairs, well-formed pictures, clear refusals.
# Usage: explain_pair_cli_test.sh PROGRAM FALLING_PARTICLES SAMPLES_FOLDER
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
program=$1
falling_particles=$2
samples=$3
picture=$work/pair.svg

# A reader of XML that is not ours looks at the picture.
if command -v xmllint >/dev/null; then
  parse() { xmllint --noout "$1"; }
elif command -v python3 >/dev/null; then
  parse() { python3 -c 'import sys, xml.dom.minidom as m; m.parse(sys.argv[1])' "$1"; }
else
  echo "skipped: there is neither xmllint nor python3 to parse the pictures with"
  parse() { :; }
fi

# draws arguments...: a picture that is well-formed, drawn within a second and below 400 KB
draws() {
  rm -f "$picture"
  local start=$EPOCHREALTIME
  expect 0 "$program" "$@" --out "$picture"
  local end=$EPOCHREALTIME
  parse "$picture" || fail "not well-formed: $*"
  [ "$(stat -c %s "$picture")" -lt 400000 ] || fail "too large: $*"
  grep -q '^hybrid *gap ' "$work/log" || fail "the answer is not printed"
  [ -n "${SLOW-}" ] || awk "BEGIN { exit !($end - $start < 1) }" || fail "slow: $*"
}

# refuses "text" arguments...: exit code 2, the text in one line of the message, no picture
refuses() {
  local text=$1
  shift
  rm -f "$picture"
  expect 2 "$program" "$@" --out "$picture"
  grep -qF -- "$text" "$work/log" || fail "unclear message: $(cat "$work/log")"
  [ ! -e "$picture" ] || fail "a picture after bad input"
}

ldd "$program" | grep -q libasan && SLOW=yes
expect 0 "$program" --help
grep -q 'superovoid A B C DELTA EPSILON' "$work/log" || fail "the help does not name the kinds of bodies"
expect 0 "$program" --list
[ "$(wc -l <"$work/log")" -eq 794 ] || fail "not 397 hard cases"

ellipsoid=(--body1 "ellipsoid 1 2 3")
draws "${ellipsoid[@]}" --body2 "superellipsoid 1 1 1 8 8" --position2 2 -1 -3 --quaternion2 0.8 0 0 -0.6 --title '<"&>'
draws "${ellipsoid[@]}" --body2 "superovoid 1 1 1 2 2 0.1 -0.1" --rounding2 0.1 --position2 -1.5 0 0 --certify
draws --body1 "superellipsoid 1 2 3 4 3" --body2 "superellipsoid 1 1 1 8 8" --position2 2 -1 -3 --literature
grep -q '^surface angles (2) *gap ' "$work/log" || fail "the literature's answers are not printed"
draws --case "concentric: identical superellipsoids 8, 20"
draws --case "colliders: an ellipsoid above a box, gap -0.0625"

expect 0 "$falling_particles" -q --no-pictures --scene "$samples/scenes/short.toml" --out "$work"
trajectory=$work/short/trajectory.csv
time=$(tail -1 "$trajectory" | cut -d, -f1)
run=(--scene "$samples/scenes/short.toml" --trajectory "$trajectory" --time "$time")
draws "${run[@]}" --bodies 7
draws "${run[@]}" --bodies 7 8

refuses '0 pairs are named; allowed: one'
refuses '2 pairs are named; allowed: one' "${ellipsoid[@]}" --case "concentric: identical ellipsoids"
refuses '--body2: "" is no kind of body; allowed: sphere, ellipsoid' "${ellipsoid[@]}"
refuses 'did you mean "concentric: identical ellipsoids"?' --case "concentric: identical elipsoids"
refuses 'missing: --bodies' "${run[@]}"
refuses '--bodies: there is no body 60; allowed: 0 to 59' "${run[@]}" --bodies 60
refuses 'is a device; allowed: a file' --scene "$samples/scenes/short.toml" --trajectory /dev/zero --time 0 --bodies 1
refuses '--position2 has a nan; allowed: ' "${ellipsoid[@]}" --body2 "sphere 1" --position2 0 nan 0
refuses '--tolerance' "${ellipsoid[@]}" --body2 "sphere 1" --tolerance 2
refuses '--max-evaluations' "${ellipsoid[@]}" --body2 "sphere 1" --max-evaluations 0
expect 1 "$program" --case "concentric: identical ellipsoids" --out "$work/missing/pair.svg"
grep -q 'cannot write ' "$work/log" || fail "does not say what failed: $(cat "$work/log")"

# What was there stays if the picture cannot be written, and what is no file is written as it is, and stays.
echo "a user's" >"$work/old.svg"
expect 1 prlimit --fsize=1000 "$program" --case "concentric: identical ellipsoids" --out "$work/old.svg"
[ "$(cat "$work/old.svg")" = "a user's" ] || fail "an earlier file is gone"
[ "$(ls "$work" | grep -c old.svg)" -eq 1 ] || fail "left beside it: $(ls "$work")"
ln -s old.svg "$work/link.svg"
expect 0 "$program" --case "concentric: identical ellipsoids" --out "$work/link.svg"
[ -L "$work/link.svg" ] && parse "$work/old.svg" || fail "a link is no link any more"
if mknod "$work/full" c 1 7 2>/dev/null; then
  expect 1 "$program" --case "concentric: identical ellipsoids" --out "$work/full"
  [ -c "$work/full" ] || fail "a device is gone"
fi
expect 1 "$program" --case "concentric: identical ellipsoids" --out /dev/full
mkfifo "$work/pipe.svg"
cat "$work/pipe.svg" >"$work/from_pipe.svg" &
expect 0 "$program" --case "concentric: identical ellipsoids" --out "$work/pipe.svg"
wait $!
parse "$work/from_pipe.svg" && [ -p "$work/pipe.svg" ] || fail "a pipe got no picture, or is gone"
echo "all passed"
