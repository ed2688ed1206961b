#!/usr/bin/env bash
# The command line of fit: its options, exit codes, messages and files.
# Usage: fit_cli_test.sh FIT
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
fit=$1
cd "$work"

# says TEXT...: the program said each of them
says() { for text; do grep -qF -- "$text" log || { cat log >&2; fail "not said: $text"; }; done; }
silent() { ! grep -qF -- "$1" log || { cat log >&2; fail "said: $1"; }; }

# ellipsoid SCALE [HALF_AXIS...]: 2000 points of an ellipsoid
ellipsoid() {
  awk -v s="$1" -v a="${2:-3}" -v b="${3:-2}" -v c="${4:-1}" 'BEGIN {
    for (i = 0; i < 2000; ++i) {
      z = 1 - (2 * i + 1) / 2000; r = sqrt(1 - z * z); t = 2.399963229728653 * i
      printf "%.15g %.15g %.15g\n", s * a * r * cos(t), s * b * r * sin(t), s * c * z
    }
  }'
}
ellipsoid 1 >egg.xyz

# Options.
expect 0 "$fit" --help
says "--table" "{auto,keep}" "not about reach and volume" "one kind of grain"
expect 2 "$fit" egg.xyz --table away
{ ellipsoid 1; awk 'BEGIN { for (x = -9; x <= 9; x += 0.8) for (y = -9; y <= 9; y += 0.8) print x, y, -1 }'; } >table.xyz
expect 0 "$fit" table.xyz --quick
says "points of a plane under the object are left out (--table keep: they are not)"
"$fit" table.xyz --table keep --quick >log 2>&1 || [ $? -eq 3 ]
silent "left out (--table keep"

# Names: words of C are names of grains, and characters that no name has are replaced with a message.
expect 0 "$fit" egg.xyz --name int --out names
grep -q "^dGeomID geom_int = snCreateEllipsoid" names/int.c && grep -q "^\[int\]$" names/int.toml || fail "names: $(cat names/int.*)"
cp egg.xyz größe.xyz
expect 0 "$fit" größe.xyz --out names
says 'the grain is called "gr__e": a name has letters, digits and _'
expect 2 "$fit" egg.xyz --name "two words"
says '--name "two words"; allowed: letters, digits and _, no digit first'

# A folder that cannot be made, and a file that cannot be written, are found before the fit.
expect 2 "$fit" egg.xyz --out egg.xyz/results
says "--out egg.xyz/results: the folder cannot be made: Not a directory"
silent "looking for"
mkdir -p full/egg.json
expect 2 "$fit" egg.xyz --out full
says "full/egg.json cannot be written: Is a directory"
silent "looking for"

# --quick writes nothing, and its exit code says whether the fit is bad.
expect 0 "$fit" egg.xyz --quick --out nowhere
[ ! -e nowhere ] || fail "--quick writes"
{ ellipsoid 1 9 1 1; ellipsoid 1 1 9 1; } >cross.xyz
expect 3 "$fit" cross.xyz --quick --outliers keep
says "warning: the root mean square distance of the data from the surface is"

# tessellated DELTA EPSILON NOISE: 1600 vertices on a superellipsoid, and the triangles between them
tessellated() {
  awk -v d="$1" -v e="$2" -v noise="$3" 'BEGIN {
    srand(1); print "OFF\n1600 3122 0"
    for (i = 0; i < 40; ++i) for (j = 0; j < 40; ++j) {
      u = (i + 0.5) * 3.14159265358979 / 40; v = j * 3.14159265358979 / 20; x = sin(u) * cos(v); y = sin(u) * sin(v); z = cos(u)
      r = ((((x / 3) ^ 2) ^ (d / 2) + ((y / 2) ^ 2) ^ (d / 2)) ^ (e / d) + (z ^ 2) ^ (e / 2)) ^ (-1 / e) + noise * (rand() - 0.5)
      printf "%.17g %.17g %.17g\n", r * x, r * y, r * z
    }
    for (i = 0; i < 39; ++i) for (j = 0; j < 40; ++j) {
      a = i * 40 + j; b = i * 40 + (j + 1) % 40
      printf "3 %d %d %d\n3 %d %d %d\n", a, a + 40, b, b, a + 40, b + 40
    }
    for (end = 0; end < 2; ++end) {
      printf "40"
      for (j = 0; j < 40; ++j) printf " %d", end ? 1599 - j : j
      print ""
    }
  }'
}

# Facets lie below a body. Where the vertices lie on it, they give its exponents.
for exponents in "4 6" "1.5 2.5" "20 3"; do
  read -r delta epsilon <<<"$exponents"
  tessellated "$delta" "$epsilon" 0 >mesh.off
  expect 0 "$fit" mesh.off --quick --shape superellipsoid
  says "the vertices are fitted" "$(printf '  %-22s %14s ±' delta "$delta")" "$(printf '  %-22s %14s ±' epsilon "$epsilon")"
done
tessellated 4 6 0.05 >noise.off
expect 0 "$fit" noise.off --quick
silent "the vertices are fitted"

# All vertices of a cylinder lie on its two rims, and these on many bodies.
awk 'BEGIN {
  print "OFF\n120 62 0"
  for (k = 0; k < 120; ++k) print cos(k * 3.14159265358979 / 30), sin(k * 3.14159265358979 / 30), k < 60 ? -1 : 1
  for (j = 0; j < 60; ++j) print 4, j, (j + 1) % 60, 60 + (j + 1) % 60, 60 + j
  for (end = 0; end < 2; ++end) { printf "60"; for (j = 0; j < 60; ++j) printf " %d", end ? 60 + j : 59 - j; print "" }
}' >cylinder.off
expect 0 "$fit" cylinder.off --quick
silent "the vertices are fitted"

# The volume of the facets says nothing of the body on which the vertices lie.
tessellated 4 6 0.001 >noise.off
expect 0 "$fit" noise.off --quick --vertices
awk '$1 == "epsilon" && ($2 - 6) ^ 2 < 0.03 ^ 2 { found = 1 } END { exit !found }' log || fail "$(cat log)"

# Units and what is open are in the JSON.
expect 0 "$fit" egg.xyz --unit mm --density 2600 --out units
grep -q '"metres_per_unit_of_file": 0.001' units/egg.json && grep -q '"density": 2600.0' units/egg.json || fail "$(cat units/egg.json)"
awk 'BEGIN {
  n = 24; m = 12; print "OFF"; print n * (m - 1), n * (m - 2), 0
  for (j = 1; j < m; ++j) for (i = 0; i < n; ++i) {
    t = 3.141592653589793 * j / m; p = 6.283185307179586 * i / n
    print 3 * sin(t) * cos(p), 2 * sin(t) * sin(p), cos(t)
  }
  for (j = 0; j < m - 2; ++j) for (i = 0; i < n; ++i) print 4, n * j + i, n * (j + 1) + i, n * (j + 1) + (i + 1) % n, n * j + (i + 1) % n
}' >open.off
"$fit" open.off --out open >log 2>&1 || [ $? -eq 3 ]
says "the mesh is open: 48 edges have one triangle; it has no volume, so its convex hull is compared"
grep -q '"kind": "open mesh"' open/open.json && grep -q '"edges_with_one_triangle": 48' open/open.json || fail "$(cat open/open.json)"
printf 'OFF\n30 10 0\n0 0 0\n1 0 0\n0 1 0\n' >short.off
expect 2 "$fit" short.off
says "the header says 30 of element vertex, but the file has room for 4 at most: is it truncated?"

# A folder of scans is one kind of grain, with a distribution of sizes. ln(1.2) is the deviation of the logarithms.
mkdir scans
for size in 8 10 12 14.4; do ellipsoid $size >scans/stone_$size.xyz; done
echo "found on a beach" >scans/notes.txt
expect 0 "$fit" scans --unit mm --density 2600 --out kind
says "scans: left out, as they are no scans: notes.txt" "fitting 4 of 4" "shape of 4 scans, ellipsoids"
grep -q "^\[scans\]$" kind/scans.toml && grep -q "^density = 2600" kind/scans.toml || fail "$(cat kind/scans.toml)"
awk 'BEGIN { n = split("8 10 12 14.4", s, " "); for (i = 1; i <= n; ++i) m += log(s[i]) / n; for (i = 1; i <= n; ++i) v += (log(s[i]) - m)^2
  printf "size = { distribution = \"lognormal\", unit = \"catalogue\", median = 1.0, geometric_deviation = %.9g,\n", exp(sqrt(v / (n - 1))) }' >expected
grep -qF "$(cat expected)" kind/scans_scene.toml || fail "$(cat expected kind/scans_scene.toml)"
grep -q '"standard_deviation"' kind/scans.json || fail "$(cat kind/scans.json)"
expect 0 "$fit" scans/stone_8.xyz scans/stone_10.xyz --name two --out kind
grep -q "^count = 2$" kind/two_scene.toml || fail "$(cat kind/two_scene.toml)"
expect 0 "$fit" scans --quick --out nowhere
[ ! -e nowhere ] || fail "--quick writes"
expect 2 "$fit" scans --bodies 2
says "--bodies 2 with several scans; allowed: 1"
echo "1 2 three" >scans/broken.xyz
expect 2 "$fit" scans
says "scans/broken.xyz:1: "
silent "fitting 1"
mkdir empty
expect 2 "$fit" empty
says "empty: 0 scans; a folder or a list of files makes one kind of grain, and takes at least 2"
echo "all passed"
