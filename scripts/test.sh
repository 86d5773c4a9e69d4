#!/usr/bin/env bash
# Sets up, builds the dev preset (assertions on, warnings are errors) and runs all tests.
# Arguments go to ctest, e.g. scripts/test.sh -R Protocol
set -euo pipefail
cd "$(dirname "$0")/.."

scripts/build.sh dev
ctest --preset dev "$@"
