#!/usr/bin/env bash
# tests/run.sh [--long]: installs what is missing, builds, runs every test, then core, formats, programs and store again under
# the address and undefined-behaviour sanitizers. The last line is "N passed, N failed"; the exit code is 0 only when
# tests ran and none failed.
#
#   --long   runs the long forms of the tests (TRUEPOSE_LONG=1: 2,000 losses of power, 200 kills under load, 20 x 10,000
#            watched events), repeats the short forms of the kill tests, runs the mutations, and proves quickstart and
#            tests in an empty Debian
#
# TRUEPOSE_PRECOMPILE=ON builds with precompiled headers: faster where ccache is empty, slower where it is not.
# TRUEPOSE_SHARED names the folder with data/ and bench/ of measured robots (default: ../shared beside the tree);
# tests that need them fail without them.
set -uo pipefail

root="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
cd "$root" || exit 1
shared="${TRUEPOSE_SHARED:-$(cd .. && pwd)/shared}"
jobs="$(nproc)"
passed=0
failed=0

say() { printf '\n== %s (%d s)\n' "$1" "$SECONDS"; }

# count FILE: adds up one JUnit report; a skipped test counts as failed, a report without tests too.
count() {
  local good bad
  read -r good bad < <(python3 tests/junit_totals.py "$1") || { good=0; bad=1; }
  passed=$((passed + good))
  failed=$((failed + bad))
}

# step WHAT COMMAND...: a step that is one test by itself.
step() {
  local what="$1"
  shift
  say "$what"
  if "$@"; then
    return 0
  fi
  echo "FAILED: $what"
  failed=$((failed + 1))
  return 1
}

# build PRESET [TARGET...]
build() {
  local preset="$1"
  shift
  cmake --preset "$preset" -DTRUEPOSE_SHARED="$shared" -DTRUEPOSE_PRECOMPILE="${TRUEPOSE_PRECOMPILE:-OFF}" >"build/$preset-configure.log" 2>&1 ||
    { cat "build/$preset-configure.log"; return 1; }
  cmake --build --preset "$preset" --parallel "$jobs" ${1:+--target "$@"}
}

# What is left of ctest's output is failures and the summary.
without_passed() { grep -vE '^ +Start +[0-9]+:| Passed +[0-9.]+ sec *$' || true; }

# run_tests FOLDER: ctest of one build folder.
run_tests() {
  local report="$root/build/junit.xml"
  rm -f "$report"
  ctest --test-dir "$1" -j "$jobs" --output-on-failure --no-tests=error --output-junit "$report" | without_passed
  count "$report"
}

dev_stage() {
  step "build dev" build dev || return
  say "test dev"
  run_tests build/dev
}

sanitizer_stage() {
  local folders=(tests/compensation tests/core tests/laws tests/formats tests/programs tests/store)
  export ASAN_OPTIONS="detect_leaks=1:strict_string_checks=1" UBSAN_OPTIONS="print_stacktrace=1:halt_on_error=1"
  step "build asan-ubsan" build asan-ubsan "${folders[@]/%//all}" || return
  for folder in "${folders[@]}"; do
    say "test $folder under sanitizers"
    run_tests "build/asan-ubsan/$folder"
  done
  unset ASAN_OPTIONS UBSAN_OPTIONS
}

# proof WHAT COMMAND...: a step of --long, which counts when it passes, too.
proof() {
  step "$@" && passed=$((passed + 1))
}

# Where a kill hits is up to the machine's timing, so more runs hit more places. The short forms: the long ones have run.
kill_again() {
  env -u TRUEPOSE_LONG ctest --test-dir build/dev -R '[Kk]ill' --repeat until-fail:10 --no-tests=error --output-on-failure | tail -n 40
}

long_stage() {
  proof "every kill test ten times" kill_again
  proof "20 mutations of core, at least 18 caught" python3 tests/mutations/mutate.py --demand 18
  proof "empty Debian" tests/chroot/empty_debian.sh
}

mkdir -p build
case "${1:-}" in
  "") ;;
  --long) export TRUEPOSE_LONG=1 ;;
  *) echo "tests/run.sh: found '$1', expected --long or nothing" >&2; exit 2 ;;
esac

step "install packages" deploy/install_packages.sh && step "install buf" tests/proto/install_buf.sh &&
  { dev_stage; sanitizer_stage; }
[ -z "${TRUEPOSE_LONG:-}" ] || long_stage

[ "$passed" -gt 0 ] || failed=$((failed > 0 ? failed : 1))
printf '\n%d passed, %d failed\n' "$passed" "$failed"
[ "$failed" -eq 0 ]
