#!/usr/bin/env bash
# Builds the packages and plays with each in a bare Debian 12, as somebody who owns nothing there and can write nowhere but
# in /tmp. Run as root; needs the Debian package debootstrap and its registry.
#   scripts/try_packages.sh FOLDER [deb|tgz|bundle...]
# FOLDER holds the bare system (made once) and one copy of it for each package. Default: all three. Ends with 1 if a package
# cannot be installed, misses a library, or does not play a flawless match.
set -Eeuo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 1 ] || { sed -n '2,6s/^# \?//p' "$0" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "try_packages: run this as root" >&2; exit 2; }
folder=$(mkdir -p "$1" && cd "$1" && pwd)
shift
[ $# -gt 0 ] || set -- deb tgz bundle

mounted=()
cleanUp() { for place in "${mounted[@]}"; do umount "$place"; done; }
trap cleanUp EXIT
trap 'echo "try_packages: line $LINENO failed; the logs are in $folder" >&2' ERR

bare() {
  [ -e "$folder/debian/etc/debian_version" ] ||
    debootstrap --variant=minbase bookworm "$folder/debian" http://deb.debian.org/debian >"$folder/debootstrap.log"
  rm -rf --one-file-system "${folder:?}/$1"
  cp -a "$folder/debian" "$folder/$1"
  cp /etc/resolv.conf /etc/hosts "$folder/$1/etc/"
  chroot "$folder/$1" useradd --no-create-home player
  mount -t proc proc "$folder/$1/proc"
  mounted+=("$folder/$1/proc")
}

# build FOLDER GENERATOR OPTION...: the release program and its package.
build() {
  local where=$1 generator=$2
  shift 2
  cmake --preset release -B "$where" "$@" >"$folder/cmake.log"
  cmake --build "$where" --target nonet nonet_env >"$folder/build.log"
  (cd "$where" && cpack -G "$generator" >"$folder/cpack.log")
}

# installThere WHERE PACKAGE...: with what they depend on.
installThere() {
  local system=$folder/$1
  shift
  chroot "$system" sh -c "apt-get update && DEBIAN_FRONTEND=noninteractive apt-get install -y \
    --no-install-recommends $*" >"$folder/install.log" 2>&1
}

newest() { ls -t "$@" | head -n 1; }

# play WHERE PROGRAM: a short match in lock-step by the unprivileged user, from a folder that is not his.
play() {
  local system=$folder/$1 program=$2
  mkdir -p "$system/srv/a folder with blanks"
  chroot --userspec=player "$system" /bin/sh -c "
    set -e; cd '/srv/a folder with blanks'; export HOME=/nonexistent
    ! touch here 2>/dev/null || { echo 'the folder can be written'; exit 1; }
    if ldd '$program' | grep 'not found'; then exit 1; fi
    '$program' --version
    '$program' match --players 3 --minutes 0.2 --kick-off-wait 1 --seed 5 --json /tmp/match.json
    grep -q '\"flawless\": true' /tmp/match.json"
  echo "try_packages: $1 plays"
}

# unpack WHERE ARCHIVE: into a folder with blanks, readable by all, writable by nobody.
unpack() {
  local place="$folder/$1/opt/our team"
  mkdir -p "$place"
  tar xzf "$2" -C "$place" --strip-components=1 --no-same-owner
  chmod -R a-w,a+rX "$place"
}

for kind in "$@"; do
  bare "$kind"
  case $kind in
    deb)
      build build/release DEB
      cp "$(newest build/release/nonet_*.deb)" "$folder/deb/tmp/nonet.deb"
      installThere deb /tmp/nonet.deb
      play deb /usr/bin/nonet
      ;;
    tgz)
      # The archive brings no libraries: they come as what the Debian package asks for, the first of alternatives.
      build build/release DEB
      needed=$(dpkg-deb -f "$(newest build/release/nonet_*.deb)" Depends | sed 's/([^)]*)//g; s/|[^,]*//g; s/,/ /g')
      installThere tgz "$needed"
      build build/release TGZ
      unpack tgz "$(newest build/release/nonet-*-Linux.tar.gz)"
      play tgz "/opt/our team/bin/nonet"
      ;;
    bundle)
      build build/bundle TGZ -DNONET_BUNDLE=ON -DNONET_TESTS=OFF
      unpack bundle "$(newest build/bundle/nonet-*-bundled.tar.gz)"
      play bundle "/opt/our team/bin/nonet"
      ;;
    *) echo "try_packages: '$kind' is none of deb, tgz, bundle" >&2; exit 2 ;;
  esac
done
