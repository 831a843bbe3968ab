#!/usr/bin/env bash
# deploy/quickstart.sh [--directory DIR] [--data DIR] [--keep]
#
# On a fresh Debian 12, as root or with sudo: installs what deploy/packages.txt lists, builds, starts a server on an
# embedded database, makes a token for you, and takes one robot from its measured session to corrected targets. May be run again: it goes on
# in the same database, with a new session and a new calibration.
#
#   --directory DIR  where database, token, log and results go (default ./truepose-quickstart)
#   --data DIR       folder that has ipa_ur10/series_C.csv (default ../shared/data beside the tree); without that file
#                    the measuring robot is simulated instead
#   --keep           leave the server running and say how to stop it
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
directory="$PWD/truepose-quickstart"
data="$root/../shared/data"
keep=""
binaries="$root/build/release"
server_pid=""

fail() { echo "quickstart.sh: $*" >&2; exit 1; }
say() { printf '\n== %s\n' "$1"; }
usage() { sed -n '2,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }

read_arguments() {
  while [ $# -gt 0 ]; do
    case "$1" in
      --directory|--data)
        [ $# -ge 2 ] || fail "$1: found nothing, expected a folder"
        [ "$1" = --data ] && data="$2" || directory="$2"
        shift ;;
      --keep) keep=1 ;;
      -h|--help) usage; exit 0 ;;
      *) fail "found '$1', expected --directory DIR, --data DIR or --keep" ;;
    esac
    shift
  done
  mkdir -p "$directory" || fail "can't make the folder $directory"
  directory="$(cd "$directory" && pwd)"
}

build() {
  say "Installing and building (the first time takes some minutes)"
  "$root/deploy/install_packages.sh" --build
  local log="$directory/build.log"
  (cd "$root" && cmake --preset release -DTRUEPOSE_PRECOMPILE=ON && cmake --build --preset release --target truepose trueposed) >"$log" 2>&1 ||
    { tail -n 40 "$log" >&2; fail "the build failed; all of it is in $log"; }
  echo "Built $binaries"
}

truepose() { "$binaries/client/cli/truepose" "$@"; }

# What a command says to do next, this script does itself.
without_next() { sed '/^Next: /d'; }

stop_server() {
  [ -n "$server_pid" ] || return 0
  kill -TERM "$server_pid" 2>/dev/null || true
  wait "$server_pid" 2>/dev/null || true
  rm -f "$directory/server.pid" "$directory/address"
}

is_running() {
  [ -s "$directory/server.pid" ] && [ -s "$directory/address" ] && kill -0 "$(cat "$directory/server.pid")" 2>/dev/null
}

start_server() {
  say "Starting the server"
  if is_running; then
    echo "One is running already, process $(cat "$directory/server.pid")"
  else
    rm -f "$directory/address"
    "$binaries/server/trueposed" --listen 127.0.0.1:0 --database "$directory/truepose.db" \
      --ready-file "$directory/address" >>"$directory/server.log" 2>&1 &
    server_pid=$!
    echo "$server_pid" >"$directory/server.pid"
    [ -n "$keep" ] || trap stop_server EXIT
    wait_until_ready
  fi
  TRUEPOSE_SERVER="$(cat "$directory/address")"
  export TRUEPOSE_SERVER
  get_token
  echo "Listening on $TRUEPOSE_SERVER, database $directory/truepose.db"
}

# The first admin of a database is who runs this script; the token stays beside the database for the next time.
get_token() {
  local token="$directory/token"
  if [ ! -s "$token" ]; then
    [ -r "$directory/truepose.db.bootstrap" ] || fail "the database has an admin, and $token with the token is gone; \
start the server with --bootstrap to make another (docs/operations.md)"
    truepose admin bootstrap "$directory/truepose.db.bootstrap" --principal "$(principal)" --output "$token" | without_next
  fi
  TRUEPOSE_TOKEN="$(cat "$token")"
  export TRUEPOSE_TOKEN
}

# The user's name as far as a principal may have it.
principal() {
  local name
  name="$(id -un | tr '[:upper:]' '[:lower:]' | tr -cd 'a-z0-9._@-' | sed 's/^[^a-z0-9]*//' | cut -c1-63)"
  echo "${name:-admin}"
}

wait_until_ready() {
  for _ in $(seq 100); do
    [ ! -s "$directory/address" ] || return 0
    kill -0 "$server_pid" 2>/dev/null || break
    sleep 0.1
  done
  tail -n 20 "$directory/server.log" >&2
  stop_server
  fail "the server did not start; its log is $directory/server.log"
}

# Sets robot, robot_file, session_file and targets.
choose_robot() {
  if [ -r "$data/ipa_ur10/series_C.csv" ]; then
    robot=ur10
    session_file="$(cd "$data" && pwd)/ipa_ur10/series_C.csv"
  else
    say "No ipa_ur10/series_C.csv in $data: simulating the measuring robot instead (--data DIR names another folder)"
    robot=measuring_robot
    session_file="$directory/simulated.csv"
    truepose simulate "$root/deploy/examples/measuring_robot.yaml" --poses 162 --seed 11 --output "$session_file" | without_next
  fi
  robot_file="$root/deploy/examples/$robot.yaml"
  targets="$root/deploy/examples/${robot}_targets.csv"
}

calibrate() {
  say "Registering the robot and importing its measured session"
  truepose robot add "$robot_file" | without_next
  name="$(sed -n 's/^robot: *\([a-z0-9-]*\).*/\1/p' "$robot_file")"
  local session
  session="$(cat /proc/sys/kernel/random/uuid)"
  truepose session import "$session_file" --robot "$name" --session-id "$session" | without_next
  say "Calibrating: even rows identify, odd rows control"
  truepose calibrate --robot "$name" --session "$session" --split even-odd --output "$directory/calibration.json"
}

compensate() {
  say "Compensating ten targets"
  local calibration
  calibration="$(python3 -c 'import json, sys; print(json.load(open(sys.argv[1]))["name"])' "$directory/calibration.json")"
  truepose compensate "$targets" --calibration "$calibration"
  truepose compensate "$targets" --calibration "$calibration" --output "$directory/corrected.csv"
}

go_on() {
  say "How to go on"
  cat <<TEXT
Corrected targets     $directory/corrected.csv
The calibration       $directory/calibration.json
Your token            $directory/token: --token-file, or copy it to ~/.config/truepose/token
Your own robot        copy $robot_file, describe the robot in it (docs/formats.md), then
                        $binaries/client/cli/truepose robot add FILE
                        $binaries/client/cli/truepose session import SESSION.csv --robot NAME
Everything truepose   $binaries/client/cli/truepose --help, docs/cli.md
TEXT
  if [ -n "$keep" ]; then
    echo "The server runs on    export TRUEPOSE_SERVER=$TRUEPOSE_SERVER"
    echo "Stop it with          kill $(cat "$directory/server.pid")"
  else
    echo "The server again      $binaries/server/trueposed --database $directory/truepose.db"
  fi
}

read_arguments "$@"
build
start_server
choose_robot
calibrate
compensate
go_on
