#!/usr/bin/env bash
# Starts one player for a technical challenge in the background: it beams itself to X Y and runs the challenge.
#   scripts/startChallengePlayer.sh HOST PORT X Y CHALLENGE
# Environment: NONET_BINARY, NONET_LOGS, NONET_TYPE (robot type, default 4), NONET_TEAM. Stop it with scripts/kill.sh.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)

if [ $# -ne 5 ]; then
  sed -n '3p' "$0" | sed 's/^# *//' >&2
  exit 2
fi
host=$1 port=$2 x=$3 y=$4 challenge=$5
binary=${NONET_BINARY:-$root/build/release/nonet}
[ -x "$binary" ] || { "$root/scripts/build.sh" release nonet >&2; binary=$root/build/release/nonet; }
logs=${NONET_LOGS:-$root/logs}
mkdir -p "$logs"
team=${NONET_TEAM:-Nonet}
setsid "$binary" play --host "$host" --port "$port" --unum 2 --team "$team" --type "${NONET_TYPE:-4}" \
  --start="$x,$y" --challenge "$challenge" >"$logs/${team}_challenge.log" 2>&1 </dev/null &
echo "$! $(awk '{ sub(/^.*\) /, ""); print $20 }' "/proc/$!/stat" 2>/dev/null || echo 0) ${team}_challenge" >>"$logs/pids"
echo "started the $challenge player for $host:$port at $x $y; log in $logs/${team}_challenge.log"
