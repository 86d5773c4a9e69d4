#!/usr/bin/env bash
# Starts the kicker of a penalty shoot-out: one agent in the background, number 9, which takes kick-offs.
# scripts/kill.sh stops it.
#   scripts/start_penalty_kicker.sh HOST [PORT]
#   scripts/start_penalty_kicker.sh HOST [-p PORT] [-t TEAM] [-mh MONITORHOST] [-- OPTIONS OF nonet play]
# Environment: as scripts/start.sh.
set -euo pipefail
. "$(dirname "$0")/common.sh"
parseArguments "$@"
oneAgent
findBinary
launch "${team}_kicker" --unum 9 --type 4 "${options[@]}"
awaitAgents
echo "started the penalty kicker of team $team for $host:$port; log in $logs/${team}_kicker.log"
