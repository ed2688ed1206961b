#!/usr/bin/env bash
# Scans become grains of falling_particles, with the sizes of the scans.
# Usage: grains_of_fit_test.sh FIT FALLING_PARTICLES SAMPLES
# Exit code 77: skipped, because falling_particles is not built.
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
fit=$1 falling_particles=$2 samples=$3
[ -x "$falling_particles" ] || {
  echo "skipped: there is no program $falling_particles"
  exit 77
}
cd "$work"

# Ellipsoids of four sizes.
mkdir scans
for size in 1 1.25 1.5 1.8; do
  awk -v s=$size 'BEGIN {
    for (i = 0; i < 500; ++i) {
      z = 1 - (2 * i + 1) / 500; r = sqrt(1 - z * z); t = 2.399963229728653 * i
      printf "%.15g %.15g %.15g\n", 3 * s * r * cos(t), 2 * s * r * sin(t), s * z
    }
  }' >scans/stone_$size.xyz
done
expect 0 "$fit" scans --unit mm --density 2600 --name stone --out kind

# A scene of a thousand of them.
sed -e 's|^catalogue = .*|catalogue = "kind/stone.toml"|' -e 's|^width = .*|width = [0.2, 0.2]|' -e '/^total = /d' \
  -e '/^\[\[grain\]\]/,/^fraction = /d' "$samples/scenes/short.toml" >scene.toml
sed 's/^count = 4$/count = 1000/' kind/stone_scene.toml >>scene.toml
expect 0 "$falling_particles" --check scene.toml
expect 0 "$falling_particles" --scene scene.toml --set time.duration=5e-4 --set time.frame=5e-4 --no-pictures --quiet --out out

# Their scales have the median 1 and the deviation of the scans. That of a normal distribution that is cut at three deviations is 0.9866 of it.
awk -F, -v sizes="1 1.25 1.5 1.8" '
  NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "scale") column = i; next }
  { x = log($column); sum += x; square += x * x; ++count }
  END {
    n = split(sizes, s, " ")
    for (i = 1; i <= n; ++i) mean += log(s[i]) / n
    for (i = 1; i <= n; ++i) variance += (log(s[i]) - mean) ^ 2 / (n - 1)
    deviation = sqrt(variance)
    ratio = sqrt(square / count) / (0.9866 * deviation)
    printf "%d grains, mean %g of a deviation, deviation %g of the expected one\n", count, sum / count / deviation, ratio
    exit !(count == 1000 && sum ^ 2 < (0.01 * count * deviation) ^ 2 && ratio > 0.99 && ratio < 1.01)
  }' out/scene/grains.csv || fail "the sizes: $(head -n 3 out/scene/grains.csv)"
echo "all passed"
