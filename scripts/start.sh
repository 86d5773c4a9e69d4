#!/usr/bin/env bash
# Starts a team on a server, in the background, one log per agent, and records the process ids for scripts/kill.sh.
#   scripts/start.sh HOST [PORT]
#   scripts/start.sh HOST [-p PORT] [-t TEAM] [-n COUNT] [-mh MONITORHOST] [-- OPTIONS OF nonet play]
# Default: nine agents of team Nonet on port 3100; at most eleven. MONITORHOST is accepted for the convention: our
# agents need no monitor. Ends with 1 if an agent dies at once, with 2 for wrong arguments. Environment: NONET_BINARY,
# NONET_LOGS (folder, default logs/), NONET_STAGGER (pause between two starts in seconds: robots born in the same cycle
# overlap and are thrown apart), NONET_WATCH (seconds until it looks who is alive; less if all have died).
set -euo pipefail
. "$(dirname "$0")/common.sh"
parseArguments "$@"
findBinary

# Robot types by uniform number, as agent::usualRobotType() has them. Every team of the first so many satisfies the
# server's rules: at most 7 of one type, any two types together at most 9, 3 different types in a team of eleven.
types=(0 2 2 2 2 2 2 2 4 1 3)
for ((unum = 1; unum <= count; unum++)); do
  [ "$unum" -eq 1 ] || sleep "${NONET_STAGGER:-0.3}"
  launch "${team}_$unum" --unum "$unum" --type "${types[unum - 1]}" "${options[@]}"
done
awaitAgents
echo "started $count agents of team $team for $host:$port; logs in $logs; stop them with scripts/kill.sh"
