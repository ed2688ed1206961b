# For scripts that install or build; to be sourced before they do. With --help (or -h as the first argument) prints the comment at the
# head of the script and ends. If the script sets the array own_help, this command follows if its program is built.
if [[ " $* " == *" --help "* || ${1:-} == -h ]]; then
  awk 'NR > 1 && !sub(/^# ?/, "") { exit } NR > 1' "$0"
  if [[ -n ${own_help[*]:-} ]]; then
    echo
    if [[ -x ${own_help[0]} ]]; then "${own_help[@]}"; else echo "Its own --help follows here once ${own_help[0]} is built."; fi
  fi
  exit 0
fi
