# Shared parts of the tests of programs; to be sourced. `work` is a separate folder, removed at the end.
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() { echo "FAILED: $*" >&2; exit 1; }

# expect CODE command...: runs it with stdout and stderr into $work/log
expect() {
  local code=$1 got=0
  shift
  "$@" >"$work/log" 2>&1 || got=$?
  [ "$got" -eq "$code" ] || { cat "$work/log" >&2; fail "exit code $got instead of $code: $*"; }
}
