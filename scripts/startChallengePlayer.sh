#!/usr/bin/env bash
# Starts one player for a technical challenge in the background: it beams itself to X Y and does what CHALLENGE asks
# for: run (straight ahead), kick (the ball to the centre, once); goalie, passing and keepaway it plays as a match.
#   scripts/startChallengePlayer.sh HOST PORT X Y CHALLENGE
# Environment: as scripts/start.sh, and NONET_TYPE (robot type, default 4), NONET_TEAM. Stop it with scripts/kill.sh.
set -euo pipefail
. "$(dirname "$0")/common.sh"
[ $# -eq 5 ] || usage
host=$1 port=$2 x=$3 y=$4 challenge=$5 team=${NONET_TEAM:-Nonet}
checkAddress
for coordinate in "$x" "$y"; do
  isReal "$coordinate" || fail "X and Y must be numbers in metres, not '$coordinate'"
done
[ -n "$challenge" ] || fail "the name of the challenge is empty"
findBinary
unum=2
[[ ${challenge,,} != *goalie* ]] || unum=1
launch "${team}_challenge" --unum "$unum" --type "${NONET_TYPE:-4}" "--start=$x,$y" --challenge "$challenge"
awaitAgents
echo "started the $challenge player for $host:$port at $x $y; log in $logs/${team}_challenge.log"
