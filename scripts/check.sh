#!/usr/bin/env bash
# Format, include rules, citations and clang-tidy over the sources, and the scripts' own tests.
# scripts/check.sh [format|includes|citations|scripts|tidy]...; default: all.
set -euo pipefail
cd "$(dirname "$0")/.."

checks=("$@")
[ ${#checks[@]} -gt 0 ] || checks=(format includes citations scripts tidy)
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
    citations)
      python3 scripts/check_citations.py --self-test
      python3 scripts/check_citations.py
      ;;
    scripts)
      for script in screen measure duels nonet_env env_example; do
        PYTHONDONTWRITEBYTECODE=1 python3 "scripts/$script.py" --self-test
      done
      ;;
    tidy)
      python3 scripts/tidy.py
      ;;
    *)
      echo "check: unknown check '$check' (format, includes, citations, scripts, tidy)" >&2
      exit 2
      ;;
  esac
done
