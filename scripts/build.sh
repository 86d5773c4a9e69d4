#!/usr/bin/env bash
# Sets up and builds a preset: scripts/build.sh [PRESET] [TARGET...]. Default: release, everything.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${1:-release}
shift || true
scripts/setup.sh
if [ ! -f "build/$preset/build.ninja" ]; then
  report=$(cmake --preset "$preset" 2>&1) || { echo "$report" >&2; exit 1; }
fi
cmake --build --preset "$preset" ${1:+--target "$@"}
