# For the scripts that start and stop agents; not run by itself. Expects $0, gives:
#   root      the folder with scripts/, params/ and skills/
#   logs      where agents write what they say, and where their process ids are kept (NONET_LOGS)
#   findBinary, parseArguments, launch, awaitAgents, anyPlays, isOurs, forgetEnded
root=$(cd "$(dirname "$0")/.." && pwd)
script=$(basename "$0" .sh)

# In a source tree logs/ beside the sources; an installation may belong to somebody else.
if [ -n "${NONET_LOGS:-}" ]; then
  logs=$NONET_LOGS
elif [ -f "$root/CMakeLists.txt" ]; then
  logs=$root/logs
elif [ -d "${HOME:-}" ] && [ -w "${HOME:-}" ]; then
  logs=${XDG_STATE_HOME:-$HOME/.local/state}/nonet
else
  logs=${TMPDIR:-/tmp}/nonet-$(id -u)
fi
pids=$logs/pids

fail() {
  echo "$script: $1" >&2
  exit 2
}
usage() {
  sed -n '/^#   scripts\//s/^#   //p' "$0" >&2
  exit 2
}

# The given one; of an installation its own; in a source tree the release build, or a new one.
findBinary() {
  binary=${NONET_BINARY:-}
  if [ -n "$binary" ]; then
    [ -x "$binary" ] || fail "NONET_BINARY $binary: there is no program"
    return
  fi
  binary=$root/build/release/nonet
  [ -f "$root/CMakeLists.txt" ] || binary=$root/../../bin/nonet
  [ ! -x "$binary" ] || return 0
  [ -x "$root/scripts/build.sh" ] || fail "there is no program nonet: set NONET_BINARY"
  "$root/scripts/build.sh" release nonet >&2
  binary=$root/build/release/nonet
}

isReal() { [[ $1 =~ ^[-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)$ ]]; }

# HOST [PORT], the league's options, folders for logs and traces; the rest, after --, goes to `nonet play`.
host=127.0.0.1 port=3100 team=Nonet count=9 countGiven=
records='' traces=''
options=()
parseArguments() {
  if [ $# -gt 0 ] && [[ $1 != -* ]]; then host=$1; shift; fi
  if [ $# -gt 0 ] && [[ $1 != -* ]]; then port=$1; shift; fi
  while [ $# -gt 0 ]; do
    case $1 in
      -p | -t | -n | -mh | -h | --host)
        [ $# -ge 2 ] || usage
        case $1 in
          -p) port=$2 ;;
          -t) team=$2 ;;
          -n) count=$2 countGiven=1 ;;
          -h | --host) host=$2 ;;
          -mh) ;;
        esac
        shift 2
        ;;
      --record | --trace)
        [[ $# -ge 2 && -n $2 && $2 != -* ]] || usage
        if [ "$1" = --record ]; then records=$2; else traces=$2; fi
        shift 2
        ;;
      --) shift; break ;;
      *) usage ;;
    esac
  done
  options=("$@")
  checkAddress
  [[ $count =~ ^([1-9]|10|11)$ ]] || fail "-n must be 1 to 11, not '$count'"
  local folder
  for folder in "$records" "$traces"; do
    [ -z "$folder" ] || mkdir -p "$folder" 2>/dev/null || fail "$folder: cannot make this folder"
  done
}
# For scripts that start one agent, whatever the count.
oneAgent() { [ -z "$countGiven" ] || fail "-n is for scripts/start.sh: this one starts one agent"; }
checkAddress() {
  [ -n "$host" ] || fail "HOST is empty"
  [[ $port =~ ^[0-9]{1,5}$ ]] && [ "$port" -ge 1 ] && [ "$port" -le 65535 ] || fail "the port must be 1 to 65535, not '$port'"
  [[ $team =~ ^[^[:space:]/\;\"\'\(\)]{1,64}$ ]] ||
    fail "team '$team': blanks, brackets, quotes, semicolons and slashes cannot be in a name"
}

# State and start time of a process: the time tells ours from a later one that happens to get the same number.
statOf() { awk '{ sub(/^.*\) /, ""); print $1, $20 }' "/proc/$1/stat" 2>/dev/null; }
# Alive (a zombie is not), and the process that was started then.
isOurs() {
  local state started
  read -r state started <<<"$(statOf "$1")" || return 1
  [ "$started" = "$2" ] && [ "$state" != Z ] && [ "$state" != X ]
}

# launch NAME ARGUMENT...: one agent in the background, its words in $logs/NAME.log, its log and its trace under that name
# in the folders that were given.
started=()
launch() {
  local name=$1 pid state began=
  shift
  [ -z "$records" ] || set -- "$@" --record "$records/$name.zst"
  [ -z "$traces" ] || set -- "$@" --trace "$traces/$name.trace"
  mkdir -p "$logs"
  setsid "$binary" play --host "$host" --port "$port" --team "$team" "$@" >"$logs/$name.log" 2>&1 </dev/null &
  pid=$!
  read -r state began <<<"$(statOf "$pid")" || true  # nothing if it has died already
  local entry="$pid ${began:-0} $name"
  { flock 8; echo "$entry" >>"$pids"; } 8>"$pids.lock"
  started+=("$entry")
}

# Keeps the ids of those who are alive, also of agents that another script has started meanwhile.
forgetEnded() {
  {
    flock 8
    [ -f "$pids" ] || return 0
    local pid time name alive=()
    while read -r pid time name; do
      isOurs "$pid" "$time" && alive+=("$pid $time $name")
    done <"$pids"
    if [ ${#alive[@]} -gt 0 ]; then
      printf '%s\n' "${alive[@]}" >"$pids"
    else
      rm -f "$pids"
    fi
  } 8>"$pids.lock"
}

# Says who died at once, with the last words; fails if anybody did. Waits NONET_WATCH seconds, less if all are dead.
awaitAgents() {
  local i looks entry pid time name dead=0
  looks=$(awk -v seconds="${NONET_WATCH:-1}" 'BEGIN { print int(10 * seconds) }')
  for ((i = 0; i < looks; i++)); do
    anyAlive || break
    sleep 0.1
  done
  for entry in "${started[@]}"; do
    read -r pid time name <<<"$entry"
    if ! isOurs "$pid" "$time"; then
      dead=$((dead + 1))
      echo "$script: $name has ended: $(grep -v "^Run with --help" "$logs/$name.log" 2>/dev/null | tail -n 1)" >&2
    fi
  done
  [ "$dead" -eq 0 ] || { echo "$script: $dead of ${#started[@]} agents did not start" >&2; return 1; }
}
# Whether one of them has said that a server took it into the team. Asking the server itself would be one connection more,
# which not every server bears (server facts 7.2, quirk 2).
anyPlays() {
  local entry pid time name
  for entry in "${started[@]}"; do
    read -r pid time name <<<"$entry"
    grep -q "^connected to " "$logs/$name.log" 2>/dev/null && return 0
  done
  return 1
}
anyAlive() {
  local entry pid time name
  for entry in "${started[@]}"; do
    read -r pid time name <<<"$entry"
    isOurs "$pid" "$time" && return 0
  done
  return 1
}
