#!/usr/bin/env python3
"""Writes the library as two files, tribox.c and tribox.h, for programs that compile it with their own sources.

FOLDER is made if it is not there. Nothing in it is overwritten. The same tree makes the same bytes.

tribox.c includes itself once for each part of each kernel. A name that several parts have at file scope is a macro in it, which
adds the part's; types that parts share are compiled once. Here a part is a .c file; a header is shared if it means the same in all
of them; any other file is a text, which each part has for itself.
"""
import argparse
import collections
import os
import re
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
TOKEN = re.compile(r"""(?P<skip>/\*.*?\*/|\s+)|^(?P<directive>[ \t]*\#(?:\\\n|/\*.*?\*/|[^\n])*)|"(?:\\.|[^"\\\n])*\""""
                   r"""|'(?:\\.|[^'\\\n])*'|(?P<word>[A-Za-z_]\w*)|\.?\d(?:[eEpP][+-]|[\w.])*|->|.""", re.S | re.M)
ARGUMENTS = r"\s*\(((?:[^()]|\((?:[^()]|\([^()]*\))*\))*)\)"
VISIBILITY = "#if defined(__GNUC__) && !defined(_WIN32)\n#pragma GCC visibility {}\n#endif\n"
ONCE, END_OF_ONCE = "#if !defined(TRIBOX_HAS_TYPES)\n", "\n#endif /* of what all parts share */"
SHARED_HERE = "/* the shared headers */\n"
GCC = "#if defined(__GNUC__) && !defined(__clang__)\n#pragma GCC {}_options\n#endif\n"
HOW = """
    cc -O2 -c tribox.c

C11 without flags, by gcc and clang; where the mathematical library is apart, link with -lm. C++ programs compile this file as C
and include tribox.h, which has the declarations of tribox_threads.h too. Keep the file's name, because it includes itself. The
kernel is chosen as the program runs; -DTRIBOX_WITHOUT_AVX512 and the like leave one out. A shared library exports what tribox.h
declares and no more; on Windows define TRIBOX_SHARED_BUILD for that.
"""
BEGINNING = """#if defined(__cplusplus)
#error "tribox.c is C, in programs of C++ as well: compile it as such, and include tribox.h"

#elif !defined(TRIBOX_PART) && !defined(TRIBOX_CORE)

#include "tribox.h"

#define TRIBOX_OF_PART__(name, part) name##_##part
#define TRIBOX_OF_PART_(name, part) TRIBOX_OF_PART__(name, part)
#define TRIBOX_OF_PART(name) TRIBOX_OF_PART_(name, TRIBOX_PART)
"""
Directive = collections.namedtuple("Directive", "start end word rest")
macros, all_macros = {}, set()  # those with parameters: {name: (parameters, body)}; the names of all


def die(text):
    sys.exit(f"amalgamate.py: {text}")


def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def union(sets):
    return set().union(*sets)


def split(text):
    """At the commas that are in no brackets."""
    parts, depth = [""], 0
    for c in text:
        depth += (c in "([{") - (c in ")]}")
        parts[-1:] = [parts[-1], ""] if c == "," and not depth else [parts[-1] + c]
    return [part.strip() for part in parts]


def expand(text):
    """With all macros that have parameters."""
    def expanded(match):
        params, body = macros[match[1]]
        given = dict(zip(params, split(match[2])))
        return expand(re.sub(r"\s*##\s*", "", re.sub(r"\b[A-Za-z_]\w*\b", lambda word: given.get(word[0], word[0]), body)))
    return re.sub(rf"\b({'|'.join(sorted(macros))}){ARGUMENTS}", expanded, text)


def replaced(pattern, new, text):
    """From the innermost outwards, until there is none."""
    count = 1
    while count:
        text, count = re.subn(pattern, new, text)
    return text


def declared(text):
    """The names before each comma, initialiser, parameter list or end of a declaration without braces."""
    text = re.sub(r"\(\s*\*\s*(?:const\s+)?(\w+)\s*\)", r" \1 ", replaced(r"\[[^][]*\]", "", text))
    names = [re.search(r"(\w+)\s*(@.*)?(:.*|=.*)?$", part, re.S) for part in split(replaced(r"\([^()]*\)", "@", text))]
    return {name[1] for name in names if name and not name[1].isdigit()}


class Item:
    """What stands at file scope: its place, its names, those of members of its types, and whether all parts share it."""

    def __init__(self, start, end, text):
        self.start, self.end, self.names, self.members = start, end, set(), set()
        text = re.sub(rf"\b(__attribute__|__declspec|_Alignas){ARGUMENTS}", "", text)
        is_made = text.split("(")[0] in macros  # by a macro
        text = expand(text) if is_made or re.match(r"(typedef\s+)?enum\b", text) else text
        count = 1
        while count:  # from the innermost braces outwards
            for kind, tag, body in re.findall(r"\b(struct|union|enum)\b\s*(\w*)\s*\{([^{}]*)\}", text):
                self.names |= {tag}
                if kind == "enum":
                    self.names |= {part.split("=")[0].strip() for part in split(body)}
                else:
                    self.members |= union(map(declared, body.split(";")))
            text, count = re.subn(r"\{[^{}]*\}", " ; " if is_made else " ", text)
        text = text.strip()
        self.names |= union(map(declared, text.split(";")))
        self.names -= {"", "struct", "union", "enum", "_Static_assert"}
        is_type = re.match(r"(__extension__\s+)?typedef\b|(struct|union|enum)\s+\w+\s*;", text)
        is_prototype = text.endswith(");") and not re.match(r"(static|TRIBOX_(NO)?INLINE|_Static_assert)\b", text)
        self.is_once = bool(is_type or is_prototype or text.startswith("extern"))


class Source:
    """A file: its items, its directives, the names of its macros, what it includes, and its guard, the directives of it."""

    def __init__(self, path, text):
        self.path, self.text, self.items, self.directives = path, text, [], []
        start, depth, words = None, [], []
        for match in TOKEN.finditer(text):
            token = match[0]
            if match["directive"]:
                bare = re.sub(r"/\*.*?\*/|\\\n", " ", token, flags=re.S).strip()[1:].split(None, 1)
                self.directives.append(Directive(match.start(), match.end(), bare[0], bare[1] if len(bare) > 1 else ""))
            if match["directive"] or match["skip"]:
                words += [" "] if words else []
                continue
            start = match.start() if start is None else start
            words.append(token)
            if token in "([{":
                depth.append(token == "{" and not depth and "".join(words[:-1]).rstrip().endswith(")") and "=" not in words)
            elif token in ")]}":
                is_body = depth.pop() if depth else die(f"{path}: a {token} too many")
            if not depth and (token == ";" or token == "}" and is_body or token == ")" and words[0] in macros):
                self.items.append(Item(start, match.end(), "".join(words)))
                if not self.items[-1].names and words[0] != "_Static_assert":
                    die(f"{path}: what does this declare? {''.join(words)[:60]}")
                start, words = None, []
        if words:
            die(f"{path}: what stands at the end is not understood: {''.join(words)[:60]}")
        ends = [self.directives[at] for at in (0, 1, -1)] if len(self.directives) > 2 else [Directive(0, 0, "", "")]
        self.guard = ends if ends[0].word == "ifndef" and ends[1][2:] == ("define", ends[0].rest) else []
        self.members = union(item.members for item in self.items)
        others = [directive for directive in self.directives if directive not in self.guard]
        self.macros = {re.match(r"\w+", directive.rest)[0] for directive in others if directive.word == "define"}
        self.included, under = [], []  # (the directive, where that is, or None of the system, under which conditions)
        for directive in others:
            if directive.word.startswith("if"):
                under.append(f"#{directive.word} {directive.rest}\n")
            elif directive.word in ("else", "elif"):
                under[-1] = None
            elif directive.word == "endif":
                under.pop()
            elif directive.word == "include":
                self.included.append((directive, self.found(directive.rest), list(under)))
        self.includes = [found for _, found, _ in self.included if found]

    def found(self, rest):
        """Where an include leads."""
        for folder in (os.path.dirname(self.path), "src", "include") if rest[0] == '"' else ():
            path = os.path.normpath(os.path.join(folder, rest.strip('"')))
            if os.path.isfile(os.path.join(ROOT, path)):
                return path
        return None if rest[0] == "<" else die(f"{self.path}: {rest} is neither beside it, nor in src, nor in include")

    def renamed(self, names):
        """The same, with these names longer by a mark where they are no members."""
        spared = [item for item in self.items if item.members & names]
        for item in spared:
            if not item.is_once:
                die(f"{self.path}: a function has a type whose member is a name at file scope, too: {item.members & names}")
        spared = [range(item.start, item.end) for item in spared]

        def longer(match):
            at, word = match.start(), match[0]
            if match["directive"]:
                return re.sub(rf"\b({'|'.join(sorted(names))})\b", r"\1_", word) if "include" not in word else word
            is_member = re.search(r"(\.|->)\s*$", self.text[max(0, at - 9):at]) or any(at in of for of in spared)
            return word + "_" * (word in names and not is_member)
        return Source(self.path, TOKEN.sub(longer, self.text))


class Library:
    """The sources of the tree, sorted into parts, texts and shared headers, and what is written of them."""

    def __init__(self):
        paths = sorted(os.path.relpath(os.path.join(folder, name), ROOT).replace(os.sep, "/")
                       for folder, _, names in os.walk(os.path.join(ROOT, "src")) for name in names if name.endswith((".c", ".h")))
        texts = {path: read(path) for path in paths}
        for name, params, body in re.findall(r"(?m)^#define (\w+)(\([^)]*\)|)((?:.*\\\n)*.*)", "\n".join(texts.values())):
            all_macros.add(name)
            if params:
                macros[name] = split(params[1:-1]), re.sub(r"/\*.*?\*/|\\\n", " ", body).strip()
        self.sources, self.early = {path: Source(path, text) for path, text in texts.items()}, {}  # {conditions: system's headers}
        kernels = re.findall(r"(?m)^(\w+) (\w+)(?: \w+:.*)?$", read("src/kernels.txt"))
        self.kernels = [(name, f"src/{folder}/{part}_{name}.c") for name, folder in kernels
                        for part in ("settle", "cells", "rows", "nodes", "pairs")]
        parts = [path for _, path in self.kernels]
        for path in parts:
            if len(self.sources[path].includes) != 2 or self.sources[path].macros != {"KERNEL"} or self.sources[path].items:
                die(f"{path}: has more than a vocabulary, KERNEL and a text")
        self.words, self.umbrellas = (list(dict.fromkeys(self.sources[path].includes[at] for path in parts)) for at in (0, 1))
        self.core = [path for path in paths if path.endswith(".c") and path not in parts]
        self.shared = self.find_shared()
        self.of_kernels, self.first = self.closure(parts), self.closure(["src/base/targets.h"])
        self.common = [path for path in self.texts_of(parts[0]) if all(path in self.texts_of(text) for text in self.umbrellas)]
        own = [path for path in self.of_kernels if path not in self.shared]
        both = union(source.members for source in self.sources.values()) & union(map(self.names_of, own))
        for path in self.core:
            if any(both & self.names_of(text) for text in self.texts_of(path)):
                die(f"{path}: a text of kernels that it includes has a name that is a member's, too")
        self.sources.update({path: self.sources[path].renamed(both) for path in own})
        self.names = union(map(self.names_of, self.of_kernels))

    def find_shared(self):
        """Headers with a guard, but for those that may mean something else in each part, and those for some processors alone."""
        shared = {path for path, source in self.sources.items() if source.guard}
        clashing = {path for path in shared if self.sources[path].macros & self.macros_of(shared - {path})}
        clashing |= {path for path in shared if all(by in clashing for by in self.sources if path in self.sources[by].includes)}
        return (shared - clashing) & {path for source in self.sources.values() for _, path, under in source.included if not under}

    def closure(self, paths, known=None):
        """These and what they include, directly or not, each after what it includes first."""
        known = [] if known is None else known
        for path in paths:
            if path in self.sources and path not in known:
                self.closure(self.sources[path].includes, known)
                known.append(path)
        return known

    def texts_of(self, path):
        return [other for other in self.closure([path]) if other not in self.shared]

    def names_of(self, path):
        """The names of a source that each part has for itself."""
        return union(item.names for item in self.sources[path].items if not item.is_once or path not in self.shared) - all_macros

    def macros_of(self, paths):
        return union(self.sources[path].macros for path in paths)

    def written(self, path):
        """A source without its guard, with texts in the place of their includes, and without what a part has from elsewhere."""
        source, has_shared = self.sources[path], path not in self.words
        edits = [(directive.start, directive.end, "") for directive in source.guard]
        for directive, target, under in source.included:
            new = ""
            if target is None:  # of the system
                if not under or path in self.of_kernels and path not in self.shared and None not in under:
                    self.early.setdefault("".join(under), set()).add(f"#include {directive.rest}\n")
                else:
                    new = seen(f"#include {directive.rest}\n")
            elif target in self.shared and target not in self.first and not has_shared:
                has_shared, new = True, "#endif\n" * len(under) + SHARED_HERE + "".join(under)
            elif path in self.first or target not in self.shared and not (target in self.common and path in self.of_kernels):
                new = self.written(target) if target in self.sources else ""
            edits.append((directive.start, directive.end, new.rstrip("\n")))
        for item in source.items if path in self.of_kernels and path in self.shared else ():
            if item.is_once:
                edits += [(item.start, item.start, ONCE), (item.end, item.end, END_OF_ONCE)]
        text, at = "", 0
        for start, end, new in sorted(edits):
            text, at = text + source.text[at:start] + new, end
        between = rf"{re.escape(END_OF_ONCE)}((?:\s|/\*(?:[^*]|\*(?!/))*\*/)*){re.escape(ONCE)}"
        text = re.sub(between, r"\1", text + source.text[at:])
        return re.sub(r"\n{3,}", "\n\n", text.strip("\n") + "\n")

    def of_core(self):
        """The parts that belong to no kernel, each after the shared headers that kernels do not include."""
        owners, known = collections.Counter(), [path for path in self.of_kernels if path in self.shared]
        for paths in [*map(self.texts_of, self.core), *([path] for path in self.shared)]:
            owners.update(union(map(self.names_of, paths)))
        for path in self.core:
            headers = [header for header in self.closure([path]) if header in self.shared and header not in known]
            known += headers
            yield from map(self.written, headers)
            names = {name for text in self.texts_of(path) for name in self.names_of(text) if owners[name] > 1}
            yield (f"#define TRIBOX_PART {base(path)}\n" + renaming(names)) * bool(names) + self.written(path)
            yield undefined(self.macros_of(self.texts_of(path)) | names | {"TRIBOX_PART"})
        yield undefined(self.macros_of(known) - self.macros_of(self.first))

    def of_kernel(self):
        """What each part of a kernel compiles: the shared headers, with its vocabulary around them, and its text."""
        words = {path: self.written(path).split(SHARED_HERE) for path in self.words}
        headers = [self.written(path) for path in self.of_kernels if path in self.shared and path not in self.first]
        texts = [*map(self.written, self.common), *(only(path, self.written(path)) for path in self.umbrellas)]
        yield self.written("src/base/targets.h")
        for under, names in sorted(self.early.items())[1:]:
            yield under + seen("".join(sorted(names))) + "#endif\n" * under.count("\n")
        yield from (only(path, head) for path, (head, _) in words.items())
        yield from [*headers, "#if defined(KERNEL)\n", *(only(path, tail) for path, (_, tail) in words.items()), *texts]
        forgotten = self.macros_of(path for path in self.of_kernels if path not in self.first)
        yield undefined({*forgotten, *map(has, self.words), *map(has, self.umbrellas)}) + "#endif\n#undef TRIBOX_PART\n"

    def tribox_c(self):
        """The text of tribox.c."""
        core, kernel, parts = "\n".join(self.of_core()), "\n".join(self.of_kernel()), ""
        for name, path in self.kernels:
            parts += f"#if TRIBOX_{name.upper()}\n" * (name != "scalar") + GCC.format("push") + f"#define KERNEL {name}\n"
            parts += "".join(f"#define {word}\n" for word in [f"TRIBOX_PART {base(path)}", *map(has, self.sources[path].includes)])
            parts += '#include "tribox.c"\n' + GCC.format("pop") + "#endif\n" * (name != "scalar") + "\n"
        mine = {"TRIBOX_HAS_TYPES", "TRIBOX_OF_PART", "TRIBOX_OF_PART_", "TRIBOX_OF_PART__"}
        return (f"{BEGINNING}\n{''.join(sorted(self.early['']))}\n"
                f'{VISIBILITY.format("push(hidden)")}{GCC.format("push")}#define TRIBOX_PART core\n#include "tribox.c"\n'
                f'#define TRIBOX_HAS_TYPES\n#define TRIBOX_CORE\n#include "tribox.c"\n#undef TRIBOX_CORE\n{GCC.format("pop")}\n'
                f"{renaming(self.names)}\n{parts}"
                f"{undefined(self.names | self.macros_of(self.first) | mine)}{VISIBILITY.format('pop')}\n"
                f"#elif defined(TRIBOX_CORE) /* all but kernels; included, as clang warns of unused functions in a main file */\n\n"
                f"{core}\n#else /* a part of a kernel, or what the core shares with them */\n\n{kernel}\n#endif\n")


def seen(includes):
    """Includes of the system, whose functions are not hidden."""
    return VISIBILITY.format("push(default)") + includes + VISIBILITY.format("pop")


def base(path):
    return os.path.basename(path)[:-2]


def has(path):
    return f"TRIBOX_HAS_{base(path)}"


def only(path, text):
    return f"#if defined({has(path)})\n{text}#endif\n"


def renaming(names):
    return "".join(f"#define {name} TRIBOX_OF_PART({name})\n" for name in sorted(names))


def undefined(names):
    return "".join(f"#undef {name}\n" for name in sorted(names))


def banner(name, how=""):
    version = ".".join(re.findall(r"(?m)^#define TRIBOX_VERSION_\w+ (\d+)$", read("include/tribox.h")))
    lines = f"{name} of tribox {version}, made from its sources by packaging/amalgamate.py\n{how}\n{read('LICENSE')}"
    return "/*\n" + "".join(f" * {line}".rstrip() + "\n" for line in lines.splitlines()) + " */\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", metavar="FOLDER")
    folder = parser.parse_args().folder
    header = read("include/tribox.h") + "\n" + read("include/tribox_threads.h").replace("#include <tribox.h>\n\n", "")
    texts = {"tribox.c": banner("tribox.c", HOW) + Library().tribox_c(), "tribox.h": banner("tribox.h") + header}
    os.makedirs(folder, exist_ok=True)
    for name in texts:
        if os.path.lexists(os.path.join(folder, name)):
            die(f"{os.path.join(folder, name)} is there already: remove it, or name another folder")
    with tempfile.TemporaryDirectory(dir=folder) as whole:
        for name, text in texts.items():
            with open(os.path.join(whole, name), "x", encoding="utf-8", newline="\n") as file:
                file.write(text)
        for name in texts:
            os.link(os.path.join(whole, name), os.path.join(folder, name))


if __name__ == "__main__":
    main()
