"""Makes tribox/_ffi.py from the public headers, so that the interface is declared in one place.

    declarations.py HEADER ... OUTPUT
"""

import os
import re
import sys

import cffi

# Lines that are for a compiler alone. The numbers of the version stay: cffi knows a #define of a number.
COMPILER_LINES = r'(?m)^(#(?!define TRIBOX_VERSION_).*|extern "C" \{|\})\n'


def main(*headers, output):
    ffi = cffi.FFI()
    for header in headers:
        with open(header, encoding="ascii") as file:
            text = re.sub(r"(?s)/\*.*?\*/", "", file.read())
        ffi.cdef(re.sub(COMPILER_LINES, "", text).replace("TRIBOX_API ", ""))
    ffi.set_source(os.path.splitext(os.path.basename(output))[0], None)
    ffi.emit_python_code(output)


main(*sys.argv[1:-1], output=sys.argv[-1])
