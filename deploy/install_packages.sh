#!/usr/bin/env bash
# install_packages.sh [--build]: installs what deploy/packages.txt lists and this Debian 12 lacks, as root or through
# sudo. Does nothing when nothing is missing.
#
#   --build  leaves out what stands below "# only tests/run.sh"
set -euo pipefail

list="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/packages.txt"

wanted() {
  if [ "$1" = --build ]; then sed '/^# only tests\/run.sh/,$d' "$list"; else cat "$list"; fi | grep -v '^#'
}

# Names of what is installed, and of what that provides: another nodejs than Debian's brings its own npm.
installed="$(dpkg-query -W -f='${db:Status-Status} ${Package}, ${Provides}\n' | sed -n 's/^installed //p' |
  tr ',' '\n' | sed 's/^ *//; s/ .*//')"

is_installed() { grep -qxF "$1" <<<"$installed"; }

missing=()
while read -r package; do
  is_installed "$package" || missing+=("$package")
done < <(wanted "${1:-}")
[ "${#missing[@]}" -gt 0 ] || exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "install_packages.sh: found neither root nor sudo, expected one of them to install: ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

echo "Installing ${#missing[@]} packages: ${missing[*]}"
log="$(mktemp)"
trap 'rm -f "$log"' EXIT
{ "${as_root[@]}" apt-get update -q &&
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
} </dev/null >"$log" 2>&1 || { tail -n 40 "$log" >&2; echo "install_packages.sh: apt-get failed, its last lines are above" >&2; exit 1; }
