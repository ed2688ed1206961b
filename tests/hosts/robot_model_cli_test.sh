#!/usr/bin/env bash
# The program robot_model: its output and its exit codes.
# Usage: robot_model_cli_test.sh PROGRAM FOLDER
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
program=$1
folder=$2

says() { grep -q -- "$1" "$work/log" || fail "no \"$1\" in: $(cat "$work/log")"; }

expect 0 "$program" "$folder/shapes.sdf"
says '^ellipsoid::link .* 0\.1000  *[0-9.]*e-'
says '^sphere::link  *sphere; body of 14.1372 kg'
expect 0 "$program" "$folder/arm.urdf" --seconds 0 --density 500
says 'no world'
expect 2 "$program"
expect 2 "$program" "$folder/shapes.sdf" --seconds -1
says 'seconds is -1, must be 1 number in \[0, 1e+06\] s'
expect 2 "$program" "$folder/shapes.sdf" --seconds nan
expect 2 "$program" "$folder/shapes.sdf" --density 0
says 'density is 0, must be 1 number in \[1e-06, 1e+12\] kg/m^3'
expect 2 "$program" "$work/missing.sdf"
says 'missing.sdf'
sed 's/<exponents>4 3</<exponents>4 0.5</' "$folder/shapes.sdf" >"$work/bad.sdf"
expect 2 "$program" "$work/bad.sdf"
says 'bad.sdf: link superellipsoid::link, collision shape: .*exponents is "4 0\.5", must be 2 numbers in \[1\.01, 1000\]'
printf '%s' '<robot name="r"><link name="l"><collision><geometry><mesh filename="x.stl"/></geometry></collision>' \
  '<collision><geometry><sphere radius="1"/></geometry></collision></link></robot>' >"$work/mesh.urdf"
expect 0 "$program" "$work/mesh.urdf" --seconds 0
says 'warning: .*mesh.urdf: link l, collision 1: <mesh> is left out; --strict refuses the file'
expect 2 "$program" "$work/mesh.urdf" --strict
says 'mesh.urdf: link l, collision 1: <geometry> has <mesh>, must be one of sphere'
echo "all passed"
