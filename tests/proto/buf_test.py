#!/usr/bin/env python3
"""buf over proto/: its style and comments, and that no release of it is broken. Each check is also given a copy that it
must refuse: a check that lets that pass fails here. And the calls against docs/api.md."""

import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROTO = ROOT / "proto"
BUF = ROOT / "build" / "buf" / "buf"


def run_buf(*arguments):
    """(exit code, what buf printed)."""
    environment = dict(os.environ, BUF_CACHE_DIR=str(BUF.parent / "cache"))
    done = subprocess.run([str(BUF), *map(str, arguments)], env=environment, text=True, check=False,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=120)
    return done.returncode, done.stdout


class BufCase(unittest.TestCase):
    def setUp(self):
        if not BUF.exists():
            self.fail(f"found no {BUF.relative_to(ROOT)}, expected it from tests/proto/install_buf.sh")
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.copy = self.folder / "proto"

    def change(self, path, old, new):
        """A copy of proto/ in which `old` stands as `new`, once."""
        shutil.copytree(PROTO, self.copy)
        file = self.copy / path
        text = file.read_text(encoding="utf-8")
        self.assertEqual(text.count(old), 1, f"{old!r} in {path}")
        file.write_text(text.replace(old, new), encoding="utf-8")

    def assert_clean(self, *arguments):
        code, output = run_buf(*arguments)
        self.assertEqual((code, output), (0, ""))

    def assert_fault(self, pattern, *arguments):
        code, output = run_buf(*arguments)
        # 100 is buf's own exit code for findings; a call that could not run has another one.
        self.assertEqual(code, 100, output)
        self.assertRegex(output, pattern)


class Lint(BufCase):
    def test_proto_is_clean(self):
        self.assert_clean("lint", PROTO)

    def test_a_field_without_comment_is_found(self):
        self.change("truepose/v1/robot.proto", "double d_m = 2;", "double d_m = 2;\n  double e_m = 9;")
        self.assert_fault(r'robot\.proto:.*"e_m" should have a non-empty comment', "lint", self.copy)

    def test_a_name_that_is_no_field_name_is_found(self):
        self.change("truepose/v1/robot.proto", "double d_m = 2;", "double dM = 2;")
        self.assert_fault(r"robot\.proto:.*should be lower_snake_case", "lint", self.copy)

    def test_an_enum_without_zero_value_suffix_is_found(self):
        """The exception is for prefixes only."""
        self.change("truepose/v1/calibration.proto", "JOB_STATE_UNSPECIFIED = 0;", "JOB_STATE_NONE = 0;")
        self.assert_fault(r"calibration\.proto:.*should be suffixed with", "lint", self.copy)


class Breaking(BufCase):
    """The tree of today stands in for a release, so that the check is known to work before the first one."""

    def setUp(self):
        super().setUp()
        self.released = self.folder / "released.binpb"
        code, output = run_buf("build", PROTO, "--exclude-source-info", "-o", self.released)
        self.assertEqual(code, 0, output)

    def breaking(self):
        return "breaking", self.copy, "--against", self.released

    def test_an_added_field_is_no_break(self):
        self.change("truepose/v1/robot.proto", "double d_m = 2;", "double d_m = 2;\n  // New.\n  double e_m = 9;")
        self.assert_clean(*self.breaking())

    def test_another_number_is_a_break(self):
        self.change("truepose/v1/session.proto", "string anchor = 19;", "string anchor = 99;")
        self.assert_fault(r'session\.proto:.*field "19" .*"anchor".* was deleted', *self.breaking())

    def test_another_type_is_a_break(self):
        self.change("truepose/v1/session.proto", "int32 reading_count = 8;", "string reading_count = 8;")
        self.assert_fault(r'session\.proto:.*"reading_count".* changed type', *self.breaking())

    def test_another_name_is_a_break(self):
        self.change("truepose/v1/session.proto", "string anchor = 19;", "string origin = 19;")
        self.assert_fault(r'session\.proto:.*changed name from "anchor" to "origin"', *self.breaking())

    def test_a_call_that_is_gone_is_a_break(self):
        self.change("truepose/v1/services.proto", "rpc SealSession(SealSessionRequest) returns (Session);", "")
        self.assert_fault(r'services\.proto:.*RPC "SealSession" .* was deleted', *self.breaking())


class Released(BufCase):
    def test_every_release_of_the_changelog_has_its_image(self):
        text = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
        # A version without a date is not out yet.
        dated = re.findall(r"^## \[(\d[^\]]*)\] - \d{4}-\d\d-\d\d", text, re.MULTILINE)
        versions = {f"v{version}.binpb" for version in dated}
        images = {path.name for path in (PROTO / "released").glob("*.binpb")}
        self.assertEqual(versions, images, "see proto/released/README.md")

    def test_no_release_is_broken(self):
        for image in sorted((PROTO / "released").glob("*.binpb")):
            with self.subTest(image.name):
                self.assert_clean("breaking", PROTO, "--against", image)


class Documented(unittest.TestCase):
    def test_every_call_stands_in_the_docs(self):
        """By its name; the six standard methods of one resource in one row by the resource's."""
        text = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
        standard = re.compile(r"^(Create|Get|List|Update|Delete|Undelete)")
        calls = [call for file in sorted((PROTO / "truepose").rglob("*.proto"))
                 for call in re.findall(r"^  rpc (\w+)\(", file.read_text(encoding="utf-8"), re.MULTILINE)]
        self.assertGreater(len(calls), 80)
        missing = [call for call in calls
                   if not re.search(rf"\b{call}\b", text) and not self.stands_as_resource(standard.sub("", call), text)]
        self.assertEqual(missing, [])

    @staticmethod
    def stands_as_resource(resource, text):
        singular = re.sub(r"ies$", "y", resource)
        return re.search(rf"(`|Undelete)({singular}|{singular.removesuffix('s')})\b", text) is not None


if __name__ == "__main__":
    unittest.main()
