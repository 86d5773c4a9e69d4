#!/usr/bin/env bash
# Stops exactly the agents that scripts/start.sh and scripts/startChallengePlayer.sh started, by their recorded
# process ids: asks with SIGTERM, insists with SIGKILL after three seconds.
set -euo pipefail
root=$(cd "$(dirname "$0")/.." && pwd)
pids=${NONET_LOGS:-$root/logs}/pids
if [ ! -f "$pids" ]; then
  echo "kill: nothing was started"
  exit 0
fi

# Alive, and still the process that was started (its start time is recorded beside its number).
isOurs() { [ "$(awk '{ sub(/^.*\) /, ""); print $20 }' "/proc/$1/stat" 2>/dev/null)" = "$2" ]; }

running=()
while read -r pid started _; do
  if isOurs "$pid" "$started"; then
    kill -TERM "$pid" 2>/dev/null && running+=("$pid $started")
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
rm -f "$pids"
echo "stopped ${#running[@]} agents"
