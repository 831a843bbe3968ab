#!/usr/bin/env python3
"""Seeded mutations of core: builds the tests of core with one small mistake at a time and sees whether a test fails.

Works in a copy of the tree. A mutant that does not compile is drawn again. Prints each mutant and, for a survivor, the line
before and after, to be looked at by hand: a mutant that changes nothing one could see is no gap in the tests.
"""

import argparse
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile

import operators

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
SECONDS_OF_ONE_RUN = 900
SECONDS_OF_THE_FIRST_BUILD = 3600  # nothing is built yet
# All tests of core; quick ones first, since the first failure decides.
TESTS_OF_CORE = ("tests/core", "tests/laws", "tests/golden")


def run(*command, cwd, seconds=SECONDS_OF_ONE_RUN):
    """Exit code and output; a run that does not end counts as failed, such as a loop that a mutant made endless."""
    try:
        done = subprocess.run(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              errors="replace", timeout=seconds)
        return done.returncode, done.stdout
    except subprocess.TimeoutExpired as late:
        return 1, str(late)


class Copy:
    """A copy of the tree, configured for core and its tests alone."""

    def __init__(self, folder):
        self.tree = folder / "tree"
        self.build = folder / "build"
        shutil.copytree(ROOT, self.tree, ignore=shutil.ignore_patterns("build", "build-*", ".git", "__pycache__"))
        shared = os.environ.get("TRUEPOSE_SHARED", str(ROOT.parent / "shared"))
        self._demand(run("cmake", "-G", "Ninja", "-S", str(self.tree), "-B", str(self.build), "-DCMAKE_BUILD_TYPE=RelWithDebInfo",
                         "-DTRUEPOSE_BUILD_SERVICE=OFF", f"-DTRUEPOSE_SHARED={shared}", cwd=self.tree))
        self._demand(self.compile(seconds=SECONDS_OF_THE_FIRST_BUILD))
        self._demand(self.test())

    @staticmethod
    def _demand(outcome):
        if outcome[0] != 0:
            sys.exit(outcome[1][-4000:] + "\nmutate.py: the tree without any mutation must build and pass")

    def compile(self, seconds=SECONDS_OF_ONE_RUN):
        return run("ninja", *(f"{folder}/all" for folder in TESTS_OF_CORE), cwd=self.build, seconds=seconds)

    def test(self):
        """The first test folder that fails, or the last one."""
        outcome = 0, ""
        for folder in TESTS_OF_CORE:
            outcome = run("ctest", "--test-dir", str(self.build / folder), "-j2", "--stop-on-failure", "--no-tests=error",
                          cwd=self.tree)
            if outcome[0] != 0:
                break
        return outcome

    def try_mutant(self, mutant):
        """caught, survived, or None when it does not compile. The file is whole again afterwards."""
        path = self.tree / mutant.path
        text = path.read_text(encoding="utf-8")
        try:
            path.write_text(mutant.apply(text), encoding="utf-8")
            if self.compile()[0] != 0:
                return None
            return "caught" if self.test()[0] != 0 else "survived"
        finally:
            path.write_text(text, encoding="utf-8")


def all_mutants():
    paths = sorted(path for suffix in ("cc", "h") for path in (ROOT / "core").rglob(f"*.{suffix}"))
    return [mutant for path in paths
            for mutant in operators.mutants_of(path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8"))]


def describe(mutant, outcome):
    print(f"{outcome:9} {mutant.path}:{mutant.line}: {mutant.mistake}", flush=True)
    if outcome == "survived":
        text = (ROOT / mutant.path).read_text(encoding="utf-8")
        print("          before: " + text.splitlines()[mutant.line - 1].strip())
        print("          after:  " + mutant.apply(text).splitlines()[mutant.line - 1].strip(), flush=True)


def judge(copy, count, seed):
    """How many of `count` mutants that compile are caught."""
    drawn = all_mutants()
    random.Random(seed).shuffle(drawn)
    outcomes = []
    while len(outcomes) < count and drawn:
        mutant = drawn.pop()
        outcome = copy.try_mutant(mutant)
        if outcome is not None:
            outcomes.append(outcome)
            describe(mutant, outcome)
    return outcomes.count("caught"), len(outcomes)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=20)
    parser.add_argument("--seed", type=int, default=2026)
    parser.add_argument("--demand", type=int, default=0, help="end with 1 when fewer are caught")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="truepose-mutations.") as folder:
        caught, tried = judge(Copy(pathlib.Path(folder)), arguments.count, arguments.seed)
    print(f"mutations: {caught} of {tried} caught, seed {arguments.seed}")
    return 0 if tried == arguments.count and caught >= arguments.demand else 1


if __name__ == "__main__":
    sys.exit(main())
