#!/usr/bin/env bash
# Starts the goalie of a penalty shoot-out: one agent, number 1, in the background. scripts/kill.sh stops it.
#   scripts/start_penalty_goalie.sh HOST [PORT]
#   scripts/start_penalty_goalie.sh HOST [-p PORT] [-t TEAM] [-mh MONITORHOST] [-- OPTIONS OF nonet play]
# Environment: as scripts/start.sh.
set -euo pipefail
. "$(dirname "$0")/common.sh"
parseArguments "$@"
oneAgent
findBinary
# Who leaves its area gives away a goal (server facts 4.11).
launch "${team}_goalie" --unum 1 --type 0 --set team.goalie.stayInArea=true "${options[@]}"
awaitAgents
echo "started the penalty goalie of team $team for $host:$port; log in $logs/${team}_goalie.log"
