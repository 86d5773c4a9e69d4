#!/usr/bin/env bash
# Installs the Debian 12 packages that the build needs and that are missing, and says which. Does nothing when
# all of them are there. NONET_SKIP_SETUP=1 only reports what is missing.
set -euo pipefail

packages=(
  g++ cmake ninja-build ccache pkg-config                # build
  libeigen3-dev libode-dev libceres-dev                  # mathematics and physics
  libasio-dev libcli11-dev libtomlplusplus-dev libfmt-dev libspdlog-dev nlohmann-json3-dev
  libzstd-dev zlib1g-dev                                 # log files
  libboost-dev                                           # Student's t distribution
  libopenmpi-dev openmpi-bin libpagmo-dev                # distributed training; CMA-ES to compare ours with
  libgtest-dev libgmock-dev libbenchmark-dev             # tests and benchmarks
  libsexp-dev libdlib-dev                                # what benchmarks compare with
  libfaketime                                            # nonet soak: a clock that jumps
  libjs-three                                            # the viewer's 3D graphics
  clang clang-format clang-tidy libclang-rt-14-dev       # checks and fuzzing
  dpkg-dev file                                          # cpack -G DEB
  python3
)

missing=()
for package in "${packages[@]}"; do
  status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
  [ "$status" = installed ] || missing+=("$package")
done
[ ${#missing[@]} -gt 0 ] || exit 0

if [ "${NONET_SKIP_SETUP:-0}" = 1 ]; then
  echo "setup: missing packages: ${missing[*]}" >&2
  exit 1
fi
if ! command -v apt-get >/dev/null; then
  echo "setup: this is not a Debian system; install by hand what these packages hold: ${missing[*]}" >&2
  exit 1
fi

asRoot=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "setup: run this as root once (no sudo here); missing packages: ${missing[*]}" >&2
    exit 1
  fi
  asRoot=(sudo)
fi

echo "setup: installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
"${asRoot[@]}" apt-get update -qq
"${asRoot[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
echo "setup: installed ${#missing[@]} packages"
