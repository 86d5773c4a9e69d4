#!/usr/bin/env bash
# Starts a team on a server, in the background, one log per agent, and records the process ids for scripts/kill.sh.
#   scripts/start.sh HOST [PORT]
#   scripts/start.sh HOST [-p PORT] [-t TEAM] [-n COUNT] [-mh MONITORHOST] [--record FOLDER] [--trace FOLDER] [-- PLAY OPTIONS]
# Default: nine agents of team Nonet on port 3100; at most eleven. MONITORHOST is accepted for the convention: our
# agents need no monitor. Each agent writes what it says to logs/TEAM_UNUM.log; with --record also a log for `nonet replay`
# and `nonet explain` to FOLDER/TEAM_UNUM.zst; with --trace what it believes and wants, for `nonet view`, to
# FOLDER/TEAM_UNUM.trace. PLAY OPTIONS are those of `nonet play`, for all agents. Ends with 1 if an agent dies at once, with 2
# for wrong arguments. As long as no server answers the agents wait, up to 30 s (`--wait` of `nonet play`): that is no error,
# but the last line tells. Environment: NONET_BINARY, NONET_LOGS (folder, default logs/), NONET_STAGGER (pause between two
# starts in seconds: robots born in the same cycle overlap and are thrown apart), NONET_WATCH (seconds until it looks who is
# alive; less if all have died).
set -euo pipefail
. "$(dirname "$0")/common.sh"
parseArguments "$@"

# What would be one file for all; how long the agents wait for a server, and whether they say so.
wait=30 quiet=
for ((i = 0; i < ${#options[@]}; i++)); do
  option=${options[i]%%=*}
  case $option in
    --record | --trace)
      [ "$count" -eq 1 ] || fail "$option after -- is one file for $count agents; $option FOLDER before it is one for each"
      ;;
    --report) [ "$count" -eq 1 ] || fail "$option after -- is one file for $count agents: give it to one, with -n 1" ;;
    --wait) if [[ ${options[i]} == *=* ]]; then wait=${options[i]#*=}; else wait=${options[i + 1]:-$wait}; fi ;;
    --quiet) quiet=1 ;;
  esac
done
findBinary

# Robot types by uniform number, as agent::usualRobotType() has them. Every team of the first so many satisfies the
# server's rules: at most 7 of one type, any two types together at most 9, 3 different types in a team of eleven.
types=(0 2 2 2 2 2 2 2 4 1 3)
for ((unum = 1; unum <= count; unum++)); do
  [ "$unum" -eq 1 ] || sleep "${NONET_STAGGER:-0.3}"
  launch "${team}_$unum" --unum "$unum" --type "${types[unum - 1]}" "${options[@]}"
done
awaitAgents
yet=
[ -n "$quiet" ] || anyPlays || yet="; no server has taken one of them in yet: they wait up to $wait s for it, then end"
echo "started $count agents of team $team for $host:$port; logs in $logs; stop them with scripts/kill.sh$yet"
