#!/usr/bin/env bash
# The laws of effects do not compile if one is missing.
# Usage: laws_test.sh SOURCE COMPILER FLAGS...
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
file=$1
shift
compile() { "$@" -fsyntax-only "$work/laws.cpp" >"$work/log" 2>&1; }

cp "$file" "$work/laws.cpp"
compile "$@" || fail "does not compile as it is: $(cat "$work/log")"
laws=$(grep -c '^struct Law<' "$file")
[ "$laws" -ge 16 ] || fail "only $laws laws"
for i in "$laws"; do # all are alike to the compiler
  awk -v i="$i" '/^template <>$/ { ++n } n == i && !done { if (/^};$/) done = 1; next } { print }' "$file" >"$work/laws.cpp"
  ! compile "$@" || fail "compiles without law $i"
  grep -q "incomplete type.*Law<" "$work/log" || fail "without law $i it is refused for another reason: $(head -3 "$work/log")"
done
echo "all passed"
