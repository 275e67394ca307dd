"""Prints the last lines of each failed test of a ctest log:  failed_tests.py LastTest.log"""

import re
import sys

LINES = 40  # of each test

with open(sys.argv[1], encoding="utf-8", errors="replace") as log:
    tests = re.split(r"(?m)^\d+/\d+ Testing: ", log.read())[1:]
for test in tests:
    if re.search(r"(?m)^Test (Passed|Skipped)\.$", test):
        continue
    name, _, rest = test.partition("\n")
    printed = rest.partition("<end of output>")[0].rstrip().splitlines()
    print(f"\n===== {name} =====")
    print("\n".join(printed[-LINES:]))
