#!/usr/bin/env bash
# Every script that installs packages prints its usage with --help, from any folder, and neither installs nor builds anything.
# Usage: help_test.sh <source folder>
set -euo pipefail
source "$(dirname "$0")/cli_test.bash"
root=$1

# What a script may start by mistake: it says so, and fails.
mkdir "$work/bin"
for program in cmake dpkg-query apt-get sudo npm debootstrap chroot ctest; do
  printf '#!/bin/sh\necho "STARTED %s"\nexit 9\n' "$program" >"$work/bin/$program"
done
chmod +x "$work/bin"/*

count=0
cd "$work"
while read -r script; do
  for option in --help -h; do
    expect 0 env PATH="$work/bin:$PATH" "$script" "$option"
    grep -qF "$(sed -n '2s/^# //p' "$script")" "$work/log" || fail "$script $option prints: $(cat "$work/log")"
    ! grep -q STARTED "$work/log" || fail "$script $option: $(cat "$work/log")"
  done
  count=$((count + 1))
done < <(grep -rlI --include=run --include=clang --include=check_plugin --include=without_optional 'install-packages\|usage\.bash' \
  "$root/.ci/run" "$root/samples" "$root/tests")
if [ -d "$root/samples/studies" ]; then
  expect 0 env PATH="$work/bin:$PATH" "$root/samples/studies/run" drum_exponents --help
  grep -q -- --seeds "$work/log" || fail "a study prints: $(cat "$work/log")"
fi
[ "$count" -ge 15 ] || fail "only $count scripts were found"
echo "$count scripts: all passed"
