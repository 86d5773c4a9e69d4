#!/usr/bin/env bash
# Format, include rules and clang-tidy over the sources. scripts/check.sh [format|includes|tidy]...; default: all.
set -euo pipefail
cd "$(dirname "$0")/.."

checks=("$@")
[ ${#checks[@]} -gt 0 ] || checks=(format includes tidy)
scripts/setup.sh

for check in "${checks[@]}"; do
  case $check in
    format)
      find include src tests -name '*.h' -o -name '*.cpp' | sort | xargs clang-format --dry-run -Werror
      echo "check: format ok"
      ;;
    includes)
      python3 scripts/check_includes.py
      ;;
    tidy)
      [ -f build/dev/compile_commands.json ] || cmake --preset dev >/dev/null
      python3 scripts/tidy.py --build build/dev
      ;;
    *)
      echo "check: unknown check '$check' (format, includes, tidy)" >&2
      exit 2
      ;;
  esac
done
