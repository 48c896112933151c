#!/usr/bin/env python3
"""no_flags.py files|bytes|fused ARGUMENT... - src needs no flags but the optimisation.

  files BUILD ROOT [OPTION...]   meson's BUILD and CMake, with these options, compile every file, CMake without a flag for the code
  bytes BUILD ROOT               the flags of BUILD make no other code of the library than none
  fused ROOT COMPILER...         where every file may have FMA, those that do not ask for it have none
"""
import json
import os
import re
import shlex
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from glob import glob

HARMLESS = r'-fPIC|-fvisibility=hidden|-fdiagnostics-.*|-fcolor-diagnostics|-mstackrealign|-O.*|-[DIg].*|-isystem.*|--target=.*'
FUSED = re.compile(r'\tvfn?m(?:add|sub)')


def all_files(root):
    return {os.path.relpath(file, root) for file in glob(os.path.join(root, 'src', '**', '*.c'), recursive=True)}


def commands_of(build, root):
    """{file of src: the words that compile it into the library}; tests compile some once more."""
    with open(os.path.join(build, 'compile_commands.json')) as file:
        commands = json.load(file)
    return {os.path.relpath(os.path.join(command['directory'], command['file']), root): shlex.split(command['command'])
            for command in commands if command.get('output', 'src/').startswith('src/')}


def check_files(build, root, *options):
    ours = all_files(root)
    faults = [f'{file}: compiled by meson or there, not by both' for file in commands_of(build, root).keys() ^ ours]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(['cmake', '-S', root, '-B', folder, '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON', *options], check=True,
                       stdout=subprocess.DEVNULL)
        cmake = {file: words for file, words in commands_of(folder, root).items() if file in ours}
    faults += [f'{file}: not compiled by CMake' for file in ours - cmake.keys()]
    asked = shlex.split(' '.join(option.partition('=')[2] for option in options if option.startswith('-DCMAKE_C_FLAGS=')))
    faults += [f'{file}: CMake compiles it with {word}' for file, words in cmake.items()
               for word in words if re.match('-[mf]|-Wa,', word) and not re.fullmatch(HARMLESS, word) and word not in asked]
    return faults


def code_of(words, file):
    """What objdump shows of the object that a command makes of a file."""
    with tempfile.TemporaryDirectory() as folder:
        target = os.path.join(folder, 'o')
        subprocess.run([*words, '-c', file, '-o', target], check=True)
        return subprocess.run(['objdump', '-dr', '--no-show-raw-insn', target], check=True, stdout=subprocess.PIPE,
                              text=True).stdout.partition('Disassembly')[2]


def check_bytes(build, root):
    def judge(file):
        words = commands[file]
        compiler = words[:1 + (os.path.basename(words[0]) == 'ccache')]
        kept = [word for word in words if re.fullmatch('-fPIC|-fvisibility=hidden|-O.|-D.*|-mstackrealign', word)]
        flags = [word for word in words if re.match('-[fm]|-std=', word)]
        with_flags, without = (code_of([*compiler, *kept, *more, f'-I{root}/include', f'-I{root}/src'], os.path.join(root, file))
                               for more in (flags, []))
        return [] if with_flags == without else [f'{file}: the flags of the build make other code']

    commands = commands_of(build, root)
    with ThreadPoolExecutor(2) as pool:
        return sum(pool.map(judge, sorted(commands)), [])


def check_fused(root, *compilers):
    def judge(pair):
        compiler, file = pair
        # Without the macro planes.h does not ask for FMA itself.
        code = code_of([compiler, '-O3', '-march=x86-64-v4', '-U__FMA__', '-Wall', '-Wextra', '-Werror', f'-I{root}/include',
                        f'-I{root}/src'], os.path.join(root, file))
        return [] if bool(FUSED.search(code)) == file.startswith(('src/avx2/pairs', 'src/avx512/pairs')) \
            else [f'{file}: {compiler} fuses operations, or makes no FMA where it should']

    kernels = ('src/avx2/', 'src/avx512/')
    files = [file for file in sorted(all_files(root)) if not file.startswith(kernels) or '/pairs' in file]
    with ThreadPoolExecutor(2) as pool:
        return sum(pool.map(judge, [(compiler, file) for compiler in compilers for file in files]), [])


def main():
    faults = {'files': check_files, 'bytes': check_bytes, 'fused': check_fused}[sys.argv[1]](*sys.argv[2:])
    print('\n'.join(faults[:9] or ['right']))
    sys.exit(bool(faults))


main()
