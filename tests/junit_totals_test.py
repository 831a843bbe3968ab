#!/usr/bin/env python3
"""The last line of tests/run.sh is only as honest as this count."""

import pathlib
import tempfile
import unittest

import junit_totals


class Totals(unittest.TestCase):
    def totals(self, cases):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "junit.xml"
            path.write_text(f"<testsuite>{cases}</testsuite>", encoding="utf-8")
            return junit_totals.totals(path)

    def test_passed_and_failed_are_told_apart(self):
        passed = '<testcase name="a" status="run"/>'
        failed = '<testcase name="b" status="fail"><failure message=""/></testcase>'
        self.assertEqual(self.totals(passed * 2 + failed), (2, 1))

    def test_skipped_and_not_run_have_failed(self):
        skipped = '<testcase name="a" status="notrun"><skipped message="x"/></testcase>'
        disabled = '<testcase name="b" status="disabled"/>'
        self.assertEqual(self.totals(skipped + disabled), (0, 2))

    def test_an_empty_report_is_a_failure(self):
        self.assertEqual(self.totals(""), (0, 1))


if __name__ == "__main__":
    unittest.main()
