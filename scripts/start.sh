#!/usr/bin/env bash
# Starts a team in the background, one log per agent, and records the process ids for scripts/kill.sh.
#   scripts/start.sh HOST [PORT]
#   scripts/start.sh HOST [-p PORT] [-t TEAM] [-n COUNT] [-mh MONITORHOST] [-- OPTIONS OF nonet play]
# Default: nine agents of team Nonet on port 3100; at most eleven. MONITORHOST is accepted for the convention: our
# agents need no monitor. Environment: NONET_BINARY, NONET_LOGS (folder, default logs/), NONET_STAGGER (pause
# between two starts in seconds: robots born in the same cycle overlap and are thrown apart).
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

usage() {
  sed -n '2,4p' "$0" | sed 's/^# \{0,1\}//' >&2
  exit 2
}
host=127.0.0.1 port=3100 team=Nonet count=9
if [ $# -gt 0 ] && [[ $1 != -* ]]; then host=$1; shift; fi
if [ $# -gt 0 ] && [[ $1 != -* ]]; then port=$1; shift; fi
while [ $# -gt 0 ]; do
  case $1 in
    -p | -t | -n | -mh | -h | --host)
      [ $# -ge 2 ] || usage
      case $1 in
        -p) port=$2 ;;
        -t) team=$2 ;;
        -n) count=$2 ;;
        -h | --host) host=$2 ;;
        -mh) ;;
      esac
      shift 2
      ;;
    --) shift; break ;;
    *) usage ;;
  esac
done
if ! [[ $count =~ ^[0-9]+$ ]] || [ "$count" -lt 1 ] || [ "$count" -gt 11 ]; then
  echo "start: -n must be 1 to 11, not '$count'" >&2
  exit 2
fi

# The binary: the given one, the release build, or a new release build.
binary=${NONET_BINARY:-$root/build/release/nonet}
[ -x "$binary" ] || { "$root/scripts/build.sh" release nonet >&2; binary=$root/build/release/nonet; }

# Robot types by uniform number. Every prefix of this list satisfies the server's rules: at most 7 of one type, any
# two types together at most 9, at least 3 different types.
types=(0 4 4 1 1 0 3 4 4 2 3)
logs=${NONET_LOGS:-$root/logs}
mkdir -p "$logs"
pids=$logs/pids
for ((unum = 1; unum <= count; unum++)); do
  [ "$unum" -eq 1 ] || sleep "${NONET_STAGGER:-0.3}"
  setsid "$binary" play --host "$host" --port "$port" --unum "$unum" --team "$team" \
    --type "${types[unum - 1]}" "$@" >"$logs/${team}_$unum.log" 2>&1 </dev/null &
  # The start time tells our process from a later one that happens to get the same number.
  echo "$! $(awk '{ sub(/^.*\) /, ""); print $20 }' "/proc/$!/stat" 2>/dev/null || echo 0) ${team}_$unum" >>"$pids"
done
echo "started $count agents of team $team for $host:$port; logs in $logs; stop them with scripts/kill.sh"
