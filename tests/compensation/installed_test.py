#!/usr/bin/env python3
"""installed_test.py CMAKE BUILD SOURCE WRITE_TABLE: installs the runtime library below a temporary folder and uses it as
a user would, with CMake and with pkg-config. Catches a symbol too many or too few, a library that it should not need, a
header or package file that is not installed or does not stand alone, an example that does not run."""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

CMAKE, BUILD, SOURCE, WRITE_TABLE = sys.argv[1:5]
EXAMPLES = pathlib.Path(SOURCE) / "compensation/examples"
TARGET = "0.1 -1.5 1.5 -1.6 -1.5 0.4".split()
# What any C++ program has, and nothing else.
SYSTEM_LIBRARIES = {"libstdc++.so.6", "libm.so.6", "libgcc_s.so.1", "libc.so.6", "ld-linux-x86-64.so.2",
                    "ld-linux-aarch64.so.1"}
FOREIGN = re.compile(r"grpc|protobuf|absl|ceres|sqlite|ssl", re.IGNORECASE)


def run(*words, **options):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **options)
    if done.returncode != 0:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.folder.cleanup)
        cls.root = pathlib.Path(cls.folder.name)
        cls.prefix = cls.root / "prefix"
        run(CMAKE, "--install", BUILD, "--component", "compensation", "--prefix", cls.prefix)
        cls.lib = next(cls.prefix.rglob("libtruepose_compensation.so")).parent
        cls.table = cls.root / "ur10.table"
        run(WRITE_TABLE, cls.table)

    def symbols(self, library, *options):
        lines = run("nm", *options, library).splitlines()
        return [line.split() for line in lines if len(line.split()) >= 2]

    def test_exports_what_the_header_declares_and_nothing_else(self):
        header = (self.prefix / "include/truepose/compensation_c.h").read_text(encoding="utf-8")
        declared = set(re.findall(r"TRUEPOSE_API[^;]*?(truepose_\w+)\(", header))
        exported = {words[-1] for words in self.symbols(self.lib / "libtruepose_compensation.so", "-D", "--defined-only")}
        self.assertEqual(exported, declared)
        self.assertGreater(len(declared), 10)

    def test_needs_no_library_beyond_the_compilers(self):
        text = run("readelf", "-d", self.lib / "libtruepose_compensation.so")
        needed = set(re.findall(r"\(NEEDED\).*\[(.*)\]", text))
        self.assertTrue(needed)
        self.assertLessEqual(needed, SYSTEM_LIBRARIES)
        self.assertIsNone(FOREIGN.search(run("ldd", self.lib / "libtruepose_compensation.so")))

    def test_archive_asks_for_nothing_foreign(self):
        undefined = {words[-1] for words in self.symbols(self.lib / "libtruepose_compensation.a", "-u", "-C")}
        self.assertEqual([name for name in undefined if FOREIGN.search(name)], [])

    def test_library_has_a_soname(self):
        self.assertIn("libtruepose_compensation.so.0", run("readelf", "-d", self.lib / "libtruepose_compensation.so"))

    def correct(self, program, **options):
        printed = run(program, self.table, *TARGET, **options)
        outcome, *joints = printed.split()
        self.assertEqual(outcome, "ok:")
        self.assertEqual(len(joints), 6)
        moved = [abs(float(found) - float(asked)) for found, asked in zip(joints, TARGET)]
        self.assertTrue(0 < max(moved) < 0.02, printed)  # errors of about 1e-3 in each link
        return printed

    def test_examples_run_with_cmake(self):
        build = self.root / "examples"
        run(CMAKE, "-S", EXAMPLES, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(CMAKE, "--build", build)
        printed = {self.correct(build / name) for name in ("correct_c", "correct_cc", "correct_static")}
        self.assertEqual(len(printed), 1, "C, C++ and static give the same joints")

    def test_examples_run_with_pkg_config(self):
        environment = {**os.environ, "PKG_CONFIG_PATH": str(self.lib / "pkgconfig"), "LD_LIBRARY_PATH": str(self.lib)}
        flags = run("pkg-config", "--cflags", "--libs", "truepose_compensation", env=environment).split()
        for compiler, source, options in (
                ("cc", "correct.c", ["-std=c99", "-pedantic"]), ("c++", "correct.cc", ["-std=c++20"])):
            program = self.root / source.replace(".", "_")
            run(compiler, *options, "-Wall", "-Wextra", "-Werror", EXAMPLES / source, "-o", program, *flags)
            self.correct(program, env=environment)

    def test_examples_say_why_they_refuse(self):
        build = self.root / "refusing"
        run(CMAKE, "-S", EXAMPLES, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run(CMAKE, "--build", build, "--target", "correct_c")
        damaged = self.root / "damaged.table"
        content = bytearray(self.table.read_bytes())
        content[-5] ^= 4
        damaged.write_bytes(content)
        for table, words in ((damaged, "damaged: digest"), (self.root / "no.table", "not_opened: ")):
            done = subprocess.run([build / "correct_c", table, *TARGET], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn(words, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
