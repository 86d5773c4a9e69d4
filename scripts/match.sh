#!/usr/bin/env bash
# Sets up, builds the release preset and plays nine against nine on the embedded server over TCP, eighteen agent
# processes. Options are those of `nonet match`, e.g. --minutes 2 --seed 7 --realtime
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/build.sh release nonet
exec build/release/nonet match "$@"
