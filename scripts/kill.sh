#!/usr/bin/env bash
# Stops exactly the agents that the start scripts started, by their recorded process ids: asks with SIGTERM, insists
# with SIGKILL after three seconds. With TEAM only those of this team.
#   scripts/kill.sh [-t TEAM]
set -euo pipefail
. "$(dirname "$0")/common.sh"
only=
if [ $# -gt 0 ]; then
  [ $# -eq 2 ] && [ "$1" = -t ] && [ -n "$2" ] || usage
  only=$2
fi
if [ ! -f "$pids" ]; then
  echo "kill: nothing was started"
  exit 0
fi

running=()
while read -r pid time name; do
  isOurs "$pid" "$time" || continue
  if [ -z "$only" ] || [ "${name%_*}" = "$only" ]; then
    kill -TERM "$pid" 2>/dev/null && running+=("$pid $time")
  fi
done <"$pids"

for ((i = 0; i < 30; i++)); do
  alive=0
  for entry in "${running[@]}"; do
    # shellcheck disable=SC2086
    isOurs $entry && alive=$((alive + 1))
  done
  [ "$alive" -gt 0 ] || break
  sleep 0.1
done
for entry in "${running[@]}"; do
  # shellcheck disable=SC2086
  if isOurs $entry; then kill -KILL "${entry%% *}" 2>/dev/null || true; fi
done
for entry in "${running[@]}"; do
  # shellcheck disable=SC2086
  for ((i = 0; i < 10; i++)); do isOurs $entry || break; sleep 0.1; done
done
forgetEnded
echo "stopped ${#running[@]} agents${only:+ of team $only}"
