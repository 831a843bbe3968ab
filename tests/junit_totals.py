#!/usr/bin/env python3
"""junit_totals.py FILE: prints "passed failed" of a JUnit report. A test that was skipped or not run has failed."""

import sys
import xml.etree.ElementTree


def totals(path):
    cases = list(xml.etree.ElementTree.parse(path).getroot().iter("testcase"))
    passed = sum(case.get("status") == "run" and case.find("failure") is None and case.find("skipped") is None
                 for case in cases)
    return passed, (len(cases) - passed) or (0 if cases else 1)


if __name__ == "__main__":
    print(*totals(sys.argv[1]))
