#!/usr/bin/env python3
"""The headers declare what programs compiled with an earlier 1.x rely on: abi.py HEADER... [record]

A line of abi.txt is a function, a type or a constant of them. Releases add lines; `record` writes all that the headers declare."""
import os
import re
import sys

RECORD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "abi.txt")


def declarations(header):
    """Each without comments, line ends and what compilers do not see; of an enumeration its constants, which may become more."""
    text = re.sub(r"/\*.*?\*/|^#.*?[^\\]$", "", header, flags=re.M | re.S)
    yield from re.findall(r"^TRIBOX_API ([^;]*;)", text, re.M)
    yield from re.findall(r"^typedef struct .*?^} \w+;", text, re.M | re.S)
    for constants, name in re.findall(r"^(?:typedef )?enum[^{]*{(.*?)} ?(\w*);", text, re.M | re.S):
        value = -1
        for constant, given in re.findall(r"(\w+)(?: = (\d+))?", constants):
            value = int(given or value + 1)
            yield "%s %s = %d" % (name or "enum", constant, value)
    yield from re.findall(r"^#define (TRIBOX_NO_\w+ .*)", header, re.M)


headers = [path for path in sys.argv[1:] if path != "record"]
declared = []
for path in headers:
    with open(path, encoding="ascii") as file:
        declared += [re.sub(r"\s+", " ", each) + "\n" for each in declarations(file.read())]
if "record" in sys.argv:
    with open(RECORD, "w", encoding="ascii") as file:
        file.writelines(declared)
with open(RECORD, encoding="ascii") as file:
    lost = [line for line in file if line not in declared]
print("%d declarations" % len(declared))
for line in lost:
    print("programs built with an earlier 1.x would break without: " + line, end="", file=sys.stderr)
sys.exit(bool(lost) or not declared)
