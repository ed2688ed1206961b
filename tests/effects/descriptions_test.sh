#!/usr/bin/env bash
# The descriptions of effects do not compile when one is missing or leaves out a text.
# Usage: descriptions_test.sh SOURCE COMPILER FLAGS...
set -euo pipefail
source "$(dirname "$0")/../cli_test.bash"
file=$1
shift
compile() { "$@" -fsyntax-only "$work/descriptions.cpp" >"$work/log" 2>&1; }

cp "$file" "$work/descriptions.cpp"
compile "$@" || fail "does not compile as it is: $(cat "$work/log")"
effects=$(grep -c '^constexpr Description kDescription<' "$file")
[ "$effects" -ge 16 ] || fail "only $effects descriptions"
for i in 1 "$effects"; do
  # Without the i-th of them, and with nothing but the name in it.
  awk -v i="$i" '/^template <>$/ { ++n } n == i && !done { if (/};$/) done = 1; next } { print }' "$file" >"$work/descriptions.cpp"
  ! compile "$@" || fail "compiles without description $i"
  awk -v i="$i" '/^template <>$/ { ++n } n == i && /^constexpr/ { sub(/",.*/, "\"};"); print; cut = !/};$/ || 1; next }
    n == i && cut { if (/^template/) cut = 0; else if (!/};$/) next; else { cut = 0; next } } { print }' "$file" >"$work/descriptions.cpp"
  ! compile "$@" || fail "compiles with a name alone as description $i"
done
echo "all passed"
