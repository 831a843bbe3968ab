#!/usr/bin/env bash
# deploy/demo-plant.sh [--directory DIR] [--binaries DIR] [--robots N]
#
# A plant in under two minutes, all of it real but the metal: one server, eight simulated robots with an agent each. They are
# measured, calibrated, approved by a second person, and get their compensation tables. Then one is bumped: its base
# by 0.5 mm, joint 3 by 0.02 deg. A check finds it, a recalibration is requested, the robot is measured again, and the new
# set is active. On a fresh Debian 12 as root or with sudo it installs and builds first.
#
#   --directory DIR  where database, tokens, spools and logs go (default a new folder, removed at the end)
#   --binaries DIR   a build folder that is there; default: builds build/release
#   --robots N       how many robots, 3 to 32 (default 8)
set -euo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
binaries=""
directory=""
robots=8
bumped=cell-3
pids=()

fail() { echo "demo-plant.sh: $*" >&2; exit 1; }
usage() { sed -n '2,11s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }

read_arguments() {
  while [ $# -gt 0 ]; do
    case "$1" in
      --directory) directory="${2:?--directory: expected a folder}"; shift ;;
      --binaries) binaries="$(cd "${2:?--binaries: expected a folder}" && pwd)"; shift ;;
      --robots) robots="${2:?--robots: expected a number}"; shift ;;
      -h|--help) usage; exit 0 ;;
      *) fail "found '$1', expected --directory DIR, --binaries DIR or --robots N" ;;
    esac
    shift
  done
  [[ "$robots" =~ ^[0-9]+$ ]] && [ "$robots" -ge 3 ] && [ "$robots" -le 32 ] || fail "--robots: found '$robots', expected 3 to 32"
}

prepare() {
  if [ -z "$binaries" ]; then
    "$root/deploy/install_packages.sh" --build
    (cd "$root" && cmake --preset release && cmake --build --preset release --target truepose trueposed truepose-simulated-agent) \
      >"${TMPDIR:-/tmp}/truepose-demo-build.log" 2>&1 || fail "the build failed: ${TMPDIR:-/tmp}/truepose-demo-build.log"
    binaries="$root/build/release"
  fi
  if [ -z "$directory" ]; then
    directory="$(mktemp -d)"
    trap 'stop_all; rm -rf "$directory"' EXIT
  else
    mkdir -p "$directory"
    [ -z "$(ls -A "$directory")" ] || fail "--directory: found files in $directory, expected a new folder"
    directory="$(cd "$directory" && pwd)"
    trap stop_all EXIT
  fi
  SECONDS=0
}

stop_all() {
  [ ${#pids[@]} -eq 0 ] || kill -TERM "${pids[@]}" 2>/dev/null || true
  wait 2>/dev/null || true
}

say() { printf '\n[%3d s] %s\n' "$SECONDS" "$*"; }

# as WHO COMMAND...: truepose with that person's token.
as() {
  local who="$1"
  shift
  "$binaries/client/cli/truepose" "$@" --server "$server" --token-file "$directory/$who.token"
}

# field EXPRESSION: of the JSON on standard input, as `d`.
field() { python3 -c 'import json, sys; d = json.load(sys.stdin); print(eval(sys.argv[1]))' "$1"; }

# wait_for WHAT COMMAND...: until the command answers 0, at most a minute.
wait_for() {
  local what="$1"
  shift
  for _ in $(seq 300); do
    "$@" && return 0
    sleep 0.2
  done
  tail -n 3 "$directory"/*.log >&2
  fail "$what: not within a minute"
}

names() { seq -f 'cell-%g' "$robots"; }

start_server() {
  "$binaries/server/trueposed" --listen 127.0.0.1:0 --database "$directory/plant.db" --ready-file "$directory/address" \
    2>"$directory/server.log" &
  pids+=($!)
  wait_for "the server's start" test -s "$directory/address"
  server="$(cat "$directory/address")"
  "$binaries/client/cli/truepose" admin bootstrap "$directory/plant.db.bootstrap" --principal anna --output "$directory/anna.token" \
    --server "$server" >/dev/null
  as anna token create --principal ben --kind person --output "$directory/ben.token" >/dev/null
  as anna token create --principal agents --kind machine --output "$directory/agents.token" >/dev/null
}

start_robot() {
  local name="$1" number="${1#cell-}"
  as anna robot add "$root/deploy/examples/ur10.yaml" --name "$name" >/dev/null
  as anna robot update "$name" --set limits.drift_rms_mm=0.2 --table-spec "$root/deploy/examples/ur10_cell.yaml" >/dev/null
  as anna placement create "$name/floor" --set instrument=instruments/tracker >/dev/null
  printf 'agent = "%s"\nserver = "%s"\ntoken_file = "agents.token"\nspool = "spool-%s"\nlisten = "127.0.0.1:0"\n%s\n[[robot]]\nname = "%s"\njoints = 6\n' \
    "$name" "$server" "$name" "largest_clock_difference_s = 0" "$name" >"$directory/$name.toml"
  mkfifo "$directory/$name.control"
  "$binaries/client/agent/simulated/truepose-simulated-agent" --config "$directory/$name.toml" --control "$directory/$name.control" \
    --robot-file "$root/deploy/examples/ur10.yaml" --seed "$number" 2>"$directory/$name.log" &
  pids+=($!)
}

command_robot() { echo "$2" >"$directory/$1.control"; }

sealed_sessions() { as anna session list --robot "$1" --filter "state = \"SEALED\" AND purpose = \"$2\"" --json; }
has_sealed() { [ "$(sealed_sessions "$1" "$2" | field 'len(d.get("sessions", []))')" -ge "$3" ]; }
newest_sealed() { sealed_sessions "$1" "$2" | field 'd["sessions"][0]["name"].split("/")[-1] if d["sessions"][0]["create_time"] >= d["sessions"][-1]["create_time"] else d["sessions"][-1]["name"].split("/")[-1]'; }
latest_calibration() { as anna calibration list --robot "$1" --json | field 'max((c["name"] for c in d["calibrations"]), key=lambda n: int(n.split("/")[-1])).replace("robots/", "").replace("/calibrations/", "#")'; }
active_table_ready() { as anna table show "$1" --json >/dev/null 2>&1; }
# The table is that of the robot's active calibration.
table_is_of() { [ "$(as anna table show "$1" --json 2>/dev/null | field 'd["calibration"].replace("robots/", "").replace("/calibrations/", "#")' 2>/dev/null)" = "$2" ]; }
# The agent has that table in use: what it names active is the file with the digest that the server tells.
agent_runs() {
  local told
  told="$(as anna table show "$1" --json 2>/dev/null | field 'd["sha256"]' 2>/dev/null)" || return 1
  [ "$told" = "$(sha256sum "$directory/spool-$1/released/$1/active.table" 2>/dev/null | cut -d' ' -f1)" ]
}

release() {
  as ben calibration approve "$1" --reason "control readings looked at" >/dev/null
  as ben calibration activate "$1" >/dev/null
}

first_calibrations() {
  local name
  for name in $(names); do command_robot "$name" "calibrate 80"; done
  for name in $(names); do wait_for "$name's session" has_sealed "$name" CALIBRATION 1; done
  say "80 poses of each robot are on the server, sealed. Anna calibrates all of them; even rows identify, odd rows check:"
  for name in $(names); do
    as anna calibrate --robot "$name" --session "$(newest_sealed "$name" CALIBRATION)" --split even-odd --json >"$directory/$name.report.json" &
    jobs_of_anna+=($!)
  done
  wait "${jobs_of_anna[@]}"
  printf '          %-8s %12s %12s %10s\n' robot 'before mm' 'after mm' verdict
  for name in $(names); do
    python3 -c 'import json, sys
r = json.load(open(sys.argv[2])); c = r["sets"]["control"]
print("          %-8s %12.3f %12.3f %10s" % (sys.argv[1], c["before"]["position_mm"]["rms"], c["after"]["position_mm"]["rms"], r["verdict"]))' \
      "$name" "$directory/$name.report.json"
  done
}

release_all() {
  local name
  for name in $(names); do release "$name#1"; done
  for name in $(names); do wait_for "$name's table" active_table_ready "$name"; done
  for name in $(names); do wait_for "$name's agent" agent_runs "$name"; done
  say "Ben has approved and activated them; the server has built and verified a table for each, and every agent runs its own:"
  as anna table show cell-1 | sed '/^Next: /d; s/^/          /'
}

# check WHAT N: a check session of the bumped robot, its N-th, and its drift check.
check() {
  command_robot "$bumped" "check 30"
  wait_for "$bumped's check" has_sealed "$bumped" CHECK "$2"
  as anna drift check "$bumped" "$(newest_sealed "$bumped" CHECK)" --json >"$directory/check-$1.json"
  field 'd["position_mm"]["rms"]' <"$directory/check-$1.json" >"$directory/check-$1.rms"
  python3 -c 'import json, sys
d = json.load(open(sys.argv[1]))
print("          RMS %.3f mm, %s" % (d["position_mm"]["rms"], "CHANGED, points to " + (d.get("attributed_to") or "no part") if d.get("changed") else "no change found"))
for f in d.get("findings", []): print("          " + f)' "$directory/check-$1.json"
}

request_state() { as anna recalibration list --robot "$bumped" --json | field 'd["recalibration_requests"][-1]["state"]'; }
request_is_done() { [ "$(request_state)" = REQUEST_DONE ]; }

recalibrate() {
  wait_for "the recalibration" request_is_done
  say "The request that the check raised went to the agent, which took 20 poses and handed them in:"
  as anna recalibration list --robot "$bumped" --json | python3 -c 'import json, sys
for s in json.load(sys.stdin)["recalibration_requests"][-1]["steps"]:
    print("          %s  %-13s by %s" % (s["time"][11:19], s["state"].replace("REQUEST_", "").lower(), s["principal"]))'
  local calibration
  calibration="$(latest_calibration "$bumped")"
  release "$calibration"
  wait_for "the new table" table_is_of "$bumped" "$calibration"
  wait_for "$bumped's agent" agent_runs "$bumped"
  say "Ben has released $calibration; its table is built, and $bumped's agent runs it."
}

main() {
  read_arguments "$@"
  prepare
  declare -a jobs_of_anna=()
  say "One server, $robots robots, an agent at each"
  start_server
  as anna instrument create tracker --set serial=DEMO position_sd_mm=0.03 >/dev/null
  local name
  for name in $(names); do start_robot "$name"; done
  first_calibrations
  release_all
  say "A check of $bumped, as it is:"
  check before 1
  say "Somebody bumps $bumped: its base by 0.5 mm, joint 3 by 0.02 deg. The next check:"
  command_robot "$bumped" bump
  check bumped 2
  recalibrate
  say "A last check of $bumped:"
  check after 3
  say "$bumped was $(printf '%.3f' "$(cat "$directory/check-before.rms")") mm off before the bump, $(printf '%.3f' "$(cat "$directory/check-bumped.rms")") mm after it, and is $(printf '%.3f' "$(cat "$directory/check-after.rms")") mm off now."
}

main "$@"
