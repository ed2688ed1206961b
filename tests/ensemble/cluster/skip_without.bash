# skip_without COMMAND...: ends the test as skipped, with exit code 77, if a program is missing; to be sourced.
skip_without() {
  local command
  for command; do
    command -v "$command" >/dev/null || {
      echo "skipped: $command is missing (tests/run cluster installs it)"
      exit 77
    }
  done
  python3 -c 'import tomllib' 2>/dev/null || {
    echo "skipped: Python 3.11 is missing (Debian package python3)"
    exit 77
  }
}
