#!/usr/bin/env python3
"""same_flags.py BUILD ROOT [OPTION...] - meson's BUILD and CMake, with these options, compile the same files with the same flags.

Compares what decides about the code of src/, and levels of optimisation where meson's build is optimised as releases are.
"""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile

# Colours, and what has an effect on some processors alone: every compiler for x86-64 has SSE2, every one for s390x this precision.
IGNORED = r'-fdiagnostics-.*|-fcolor-diagnostics|-msse2|-fexcess-precision=fast'
SHOWN = 5


def flags_of_files(build, source):
    """Of every file below source, the flags that make its code: {file: {flag}}. Those of all files come last."""
    with open(os.path.join(source, 'kernels.txt')) as file:
        last = re.search('(?m)^all:(.*)$', file.read()).group(1).split()
    with open(os.path.join(build, 'compile_commands.json')) as file:
        commands = json.load(file)
    files = {}
    for command in commands:
        path = os.path.realpath(os.path.join(command['directory'], command['file']))
        is_library = command.get('output', 'src/').startswith('src/')  # tests compile some files once more
        if is_library and path.startswith(source + os.sep) and path.endswith('.c'):
            words = shlex.split(command['command'])
            heeded = '-[mf]|-Wa,|-std=' + ('|-DTRIBOX_[A-Z0-9]*$' if path.endswith('dispatch.c') else '')
            flags = {word for word in words if re.match(heeded, word) and not re.fullmatch(IGNORED, word)}
            if [word for word in words if re.match('-[fmO]', word)][-len(last):] != last:
                sys.exit(f'{path}: a flag comes after {" ".join(last)}')
            levels = [word for word in words if re.match('-O', word)]
            files[os.path.relpath(path, source)] = flags | set(levels[-1:])
    return files


def main():
    build, root, *options = sys.argv[1:]
    source = os.path.realpath(os.path.join(root, 'src'))
    meson = flags_of_files(build, source)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(['cmake', '-S', root, '-B', folder, '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON', *options], check=True,
                       stdout=subprocess.DEVNULL)
        cmake = flags_of_files(folder, source)
    if not all('-O3' in flags for flags in meson.values()):
        meson, cmake = ({file: {flag for flag in flags if flag[:2] != '-O'} for file, flags in build.items()}
                        for build in (meson, cmake))
    different = [file for file in sorted(meson.keys() | cmake.keys()) if meson.get(file) != cmake.get(file)]
    for file in different[:SHOWN]:
        if file in meson and file in cmake:
            print(f'src/{file}: by meson alone with {meson[file] - cmake[file]}, by CMake alone with {cmake[file] - meson[file]}')
        else:
            print(f'src/{file}: compiled by {"meson" if file in meson else "CMake"} alone')
    print(f'{len(meson)} files compared, {len(different)} differ')
    sys.exit(bool(different) or not meson)


main()
