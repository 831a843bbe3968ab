#!/usr/bin/env bash
# Installs the pinned buf (package-lock.json) as build/buf/buf below the tree. Does nothing when it is there. The only
# step that may need a network; npm asks its own cache first.
set -euo pipefail

here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
folder="$(cd "$here/../.." && pwd)/build/buf"

fail() { echo "install_buf.sh: $*" >&2; exit 1; }

# A copy of the lock file, made last, says that all before went well.
if cmp -s "$here/package-lock.json" "$folder/installed.json"; then exit 0; fi

command -v npm >/dev/null || fail "found no npm, expected it installed (deploy/install_packages.sh)"
mkdir -p "$folder"
cd "$folder"
rm -f installed.json buf
cp "$here/package.json" "$here/package-lock.json" "$here/.npmrc" .
npm ci --prefer-offline --no-progress --loglevel=error >install.log 2>&1 ||
  { tail -n 20 install.log >&2; fail "npm ci failed, its last lines are above"; }
# The packages are one a processor; npm takes the one that fits.
program="$(find node_modules/@bufbuild -path '*/bin/buf' -type f -print -quit)"
[ -n "$program" ] || fail "found no buf for $(uname -m), expected x86_64 or aarch64"
ln -s "$program" buf
cp package-lock.json installed.json
