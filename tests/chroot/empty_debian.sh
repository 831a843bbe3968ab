#!/usr/bin/env bash
# empty_debian.sh [DIRECTORY]: proves the two commands where nothing is installed. Makes a minimal Debian 12 in a new
# folder (below DIRECTORY, default the temporary folder), puts a clone of this tree there, runs deploy/quickstart.sh
# and .ci/run in it and prints how long each took. Runs as root; packages come from where this host has its own.
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
shared="${TRUEPOSE_SHARED:-$(cd "$root/.." && pwd)/shared}"

fail() { echo "empty_debian.sh: $*" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || fail "found user $(id -un), expected root"
command -v debootstrap >/dev/null || fail "found no debootstrap, expected it installed (apt-get install debootstrap)"

debian="$(mktemp -d "${1:-${TMPDIR:-/tmp}}/truepose-debian.XXXXXX")"
chmod 755 "$debian"

clean_up() {
  local mounted
  for mounted in dev/pts dev proc; do
    ! mountpoint -q "$debian/$mounted" || umount -l "$debian/$mounted"
  done
  # Never through a mount that could not be taken away.
  rm -rf --one-file-system "$debian"
}
trap clean_up EXIT

# The mirror that this host takes bookworm from, in either form of apt's sources.
mirror() {
  { sed -n 's/^URIs: *\([^ ]*\).*/\1/p' /etc/apt/sources.list.d/*.sources
    sed -n 's/^deb \(\[.*\] \)\{0,1\}\([^ ]*\) bookworm .*/\2/p' /etc/apt/sources.list /etc/apt/sources.list.d/*.list
  } 2>/dev/null | grep -m 1 '/debian/*$'
}

# What the host needs to reach its mirror, the new Debian needs too.
copy_network_settings() {
  cp /etc/resolv.conf "$debian/etc/resolv.conf"
  cp -r /etc/apt/apt.conf.d/. "$debian/etc/apt/apt.conf.d/"
  cp /etc/apt/apt.conf "$debian/etc/apt/" 2>/dev/null || true
  if [ -d /usr/local/share/ca-certificates ]; then
    mkdir -p "$debian/usr/local/share/ca-certificates"
    cp -r /usr/local/share/ca-certificates/. "$debian/usr/local/share/ca-certificates/"
  fi
  ! command -v npm >/dev/null || echo "registry=$(npm config get registry)" >"$debian/root/.npmrc"
}

make_debian() {
  debootstrap --variant=minbase bookworm "$debian" "$(mirror)" >"$debian.log" 2>&1 ||
    { tail -n 20 "$debian.log" >&2; fail "debootstrap failed"; }
  rm -f "$debian.log"
  copy_network_settings
  mount --bind /proc "$debian/proc"
  mount --bind /dev "$debian/dev"
  mount --bind /dev/pts "$debian/dev/pts"
}

put_tree() {
  mkdir -p "$debian/home/engineer"
  git clone -q "$root" "$debian/home/engineer/truepose"
  [ ! -d "$shared" ] || cp -r "$shared" "$debian/home/engineer/shared"
}

inside() {
  chroot "$debian" /usr/bin/env -i HOME=/root LANG=C.UTF-8 PATH=/usr/sbin:/usr/bin:/sbin:/bin \
    ${http_proxy:+http_proxy="$http_proxy"} ${https_proxy:+https_proxy="$https_proxy"} \
    ${NODE_EXTRA_CA_CERTS:+NODE_EXTRA_CA_CERTS="$NODE_EXTRA_CA_CERTS"} \
    /bin/bash -c "cd /home/engineer/truepose && $1"
}

timed() {
  local begin=$SECONDS
  "${@:2}"
  echo "empty Debian: $1 took $((SECONDS - begin)) s"
}

timed "debootstrap" make_debian
put_tree
timed "deploy/quickstart.sh" inside "deploy/quickstart.sh --directory /root/first"
timed "deploy/quickstart.sh again" inside "deploy/quickstart.sh --directory /root/first"
timed "deploy/quickstart.sh without data" inside "deploy/quickstart.sh --directory /root/second --data /nowhere"
timed ".ci/run" inside ".ci/run"
