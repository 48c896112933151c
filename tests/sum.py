#!/usr/bin/env python3
"""Adds up what meson ran, from testlog.json: the cases that cmocka counts, and one for every other test."""
import json
import re
import sys

passed = failed = skipped = 0
for path in sys.argv[1:]:
    with open(path, encoding="utf-8") as log:
        for test in map(json.loads, log):
            text = (test.get("stdout") or "") + (test.get("stderr") or "")
            cases = [sum(map(int, re.findall(rf"\[  {word}  \] (\d+) test", text))) for word in ("PASSED", "FAILED", "SKIPPED")]
            if test["result"] == "SKIP":
                skipped += 1
            elif test["result"] == "OK":
                passed += max(1, cases[0])
                skipped += cases[2]
            else:
                passed += cases[0]
                failed += max(1, cases[1])
print(f"{passed} passed, {failed} failed" + (f", {skipped} skipped" if skipped else ""))
