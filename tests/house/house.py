#!/usr/bin/env python3
"""house.py ROOT: the house is as CONTRIBUTING.md and src/README.md say: folders, who uses whom, files, lines, links."""
import collections
import os
import re
import subprocess
import sys

ROOT = sys.argv[1] if len(sys.argv) > 1 else "."
MOST = 15  # sources in a folder of src
COLUMNS = 132
SYSTEM = {"setjmp.h"}  # stands in for that of a system
failures = []


def fail(text):
    failures.append(text)


def tracked():
    listed = subprocess.run(["git", "-C", ROOT, "ls-files", "-co", "--exclude-standard"], capture_output=True, text=True,
                            check=False)
    if listed.returncode:  # a tarball
        found = (os.path.relpath(os.path.join(folder, name), ROOT) for folder, _, names in os.walk(ROOT) for name in names)
        return [name for name in found if name.split(os.sep)[0] in ("include", "src", "tools", "tests", "bench", "examples")]
    return [name for name in listed.stdout.splitlines() if os.path.isfile(os.path.join(ROOT, name))]


def read(name):
    with open(os.path.join(ROOT, name), encoding="utf-8") as file:
        return file.read()


def folder_of(name):
    """Of a path below src: its folder, that of the texts for those below it; "" for the files at the top."""
    parts = name.split("/")
    return parts[0] if len(parts) > 1 else ""


FILES = tracked()
KERNELS = dict(re.findall(r"(?m)^(\w+) (\w+)$", read("src/kernels.txt")))  # {kernel: its folder}
VOCABULARIES = set(KERNELS.values())
SOURCES = [name[4:] for name in FILES if re.fullmatch(r"src/.*\.[ch]", name)]

# No two headers share a base name, nor two sources of the library, whose objects a compiler puts into one folder; and no folder of
# src is a heap.
for base, count in collections.Counter(os.path.basename(name) for name in FILES if re.search(r"\.h$|^src/.*\.c$", name)).items():
    if count > 1 and base not in SYSTEM:
        fail(f"{base}: {count} files have this name; rename one")
for folder, count in collections.Counter(os.path.dirname(name) for name in SOURCES).items():
    if count > MOST:
        fail(f"src/{folder}: {count} sources, more than {MOST}; make a folder of those that change together")

# src/README.md's table names every folder, and each uses what it says. The types of the top are everybody's.
page = read("src/README.md")
may_use = {}
for folders, uses in re.findall(r"^\| (.*?) \| .*? \| (.*?) \|$", page, re.M):
    for folder in re.findall(r"`(\w+)/`", folders):
        may_use[folder] = set(re.findall(r"`(\w+)/`", uses))
folders = {folder_of(name) for name in SOURCES} - {""}
for folder in sorted(folders ^ set(may_use)):
    fail(f"src/README.md: the folder {folder}/ is in the table or in src, but not in both")


def reach(folder, seen=()):
    """The folders that one may use, directly or through others."""
    return may_use.get(folder, set()).union(*(reach(to, (*seen, folder)) for to in may_use.get(folder, ()) if to not in seen))


for name in SOURCES:
    folder = folder_of(name)
    for include in re.findall(r'(?m)^\s*#\s*include "(\w+)/', read("src/" + name)):
        allowed = {folder, "base"} | reach(folder)
        if folder == "kernel":
            allowed |= {"voxels", "index", "fill"}  # lists and types that they fill
        if folder in VOCABULARIES or folder == "exact":
            allowed |= {"kernel"}
        if folder and include not in allowed:
            fail(f"src/{name}: includes {include}/, which src/README.md does not let {folder}/ use")
        if include in VOCABULARIES and include != folder:
            fail(f"src/{name}: knows an instruction set")

# What users read names them all: WebAssembly has its own documents.
for name in ("include/tribox.h", "tools/manual.txt", "CHANGELOG.md"):
    for kernel in KERNELS:
        if not re.search(rf"\b{kernel}\b", read(name)) and kernel != "wasm128":
            fail(f"{name}: does not name the kernel {kernel} of src/kernels.txt")

# All ask the compiler for arithmetic as it is written.
def reach_file(name, seen):
    seen.add(name)
    for include in re.findall(r'(?m)^\s*#\s*include "(.*)"', read("src/" + name)):
        for file in (os.path.join(os.path.dirname(name), include), include):
            if file in SOURCES and file not in seen:
                reach_file(file, seen)
    return seen


for name in SOURCES:
    if name.endswith(".c") and "base/compiler.h" not in reach_file(name, set()):
        fail(f"src/{name}: does not include base/compiler.h, not even through others")

# No static name stands in two files: what a backtrace or grep shows is one thing. Words of a vocabulary are meant to be alike.
WORDS = re.compile(rf"src/({'|'.join(VOCABULARIES)})/|num_\w+\.h|exact_(short|long)\.c")
defined = collections.defaultdict(set)
for name in FILES:
    if re.match(r"src/.*\.[ch]$", name) and not WORDS.search(name):
        for function in re.findall(r"(?m)^(?:static (?:inline )?|TRIBOX_(?:INLINE|NOINLINE) )[\w *]*?\b(\w+)\(", read(name)):
            defined[function].add(name)
for function, names in sorted(defined.items()):
    if len(names) > 1:
        fail(f"{function}() is static in {', '.join(sorted(names))}; give each its object")

# A journey leads to files that exist.
for text in re.findall(r"`([\w/]+\.[ch])`", page):
    if f"src/{text}" not in FILES and f"src/kernel/{text}" not in FILES:
        fail(f"src/README.md: there is no file {text}")
for text in re.findall(r"^\| \**`([\w/]+\.h)`", read("src/kernel/README.md"), re.M):
    if f"src/kernel/{text}" not in FILES:
        fail(f"src/kernel/README.md: there is no file {text}")

# A branch is an if, and lines fit a screen.
for name in FILES:
    if re.search(r"\.(c|h|cc|[ch]pp|py|sh|mjs)$", name):
        for number, line in enumerate(read(name).splitlines(), 1):
            if re.search(r"\.(c|h|cc|[ch]pp)$", name) and re.search(r"\? [\w>.-]+ : [\w>.-]+\)\(", line):
                fail(f"{name}:{number}: (c ? f : g)(x) is not found by grep; write an if")
            if len(line) > COLUMNS:
                fail(f"{name}:{number}: {len(line)} columns, more than {COLUMNS}")


# A link leads to a file that is there, and to a heading that it has.
def anchors(name):
    return {re.sub(r"[^\w -]", "", title.lower()).replace(" ", "-") for title in re.findall(r"(?m)^#+ (.*)", read(name))}


for name in FILES:
    links = re.findall(r"\]\(([^)\s]+)\)", re.sub(r"```.*?```|`[^`\n]*`", "", read(name),
                                                  flags=re.S)) if name.endswith(".md") else []
    for path, _, anchor in (link.partition("#") for link in links if not link.startswith("https:")):
        to = os.path.normpath(os.path.join(os.path.dirname(name), path)) if path else name
        if path.startswith("/") or not os.path.exists(os.path.join(ROOT, to)) or anchor and anchor not in anchors(to):
            fail(f"{name}: the link {path}#{anchor} leads nowhere")

print(*failures, sep="\n")
print(f"{len(SOURCES)} sources in {len(folders)} folders, {len(failures)} faults")
sys.exit(bool(failures))
