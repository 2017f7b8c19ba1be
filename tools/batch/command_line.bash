# Parses the command line of parallel-shards and slurm-shards:
#   SCRIPT N [options of the scheduler] -- JOBS.jsonl -o DIR [options of lapwing batch]
# read_command_line SCRIPT ARGUMENTS... sets `shards` (N), `options` and `batch` (the arguments
# before and after "--", as arrays) and `lapwing` (the program: $LAPWING, or lapwing from PATH). For
# --help, prints the comment at the beginning of SCRIPT. After an error, prints a message and exits
# with 2.

wrong_usage() {
  echo "$1 (see --help)" >&2
  exit 2
}

opening_comment() {
  sed -n '2,/^[^#]/s/^# \{0,1\}//p' "$1"
}

read_command_line() {
  local script=$1
  shift
  if [ "${1:-}" = --help ] || [ "${1:-}" = -h ]; then
    opening_comment "$script"
    exit 0
  fi
  shards=${1:-}
  [[ $shards =~ ^[1-9][0-9]*$ ]] ||
    wrong_usage "The first argument is the number of shards, not '$shards'"
  shift
  options=()
  while [ $# -gt 0 ] && [ "$1" != -- ]; do
    options+=("$1")
    shift
  done
  [ $# -gt 1 ] || wrong_usage "Give the arguments of lapwing batch after --: JOBS.jsonl -o DIR"
  shift
  batch=("$@")
  local argument
  for argument in "${batch[@]}"; do
    case $argument in
      --shard | --shard=*) wrong_usage "The script chooses the shards; remove $argument" ;;
    esac
  done
  lapwing=$(command -v "${LAPWING:-lapwing}") ||
    wrong_usage "No program ${LAPWING:-lapwing}: add lapwing to PATH, or set LAPWING to its path"
  case $lapwing in
    /*) ;;
    *) lapwing=$PWD/$lapwing ;;
  esac
}

# need PROGRAM PACKAGE: exits with 1 and a message if PROGRAM is not installed.
need() {
  command -v "$1" >/dev/null || {
    echo "The program $1 was not found: install it (on Debian, apt-get install $2)" >&2
    exit 1
  }
}
