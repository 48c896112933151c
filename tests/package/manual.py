#!/usr/bin/env python3
"""The manual page made from the header has all that the header declares: manual.py HEADER PAGE

Prototypes and types agree to the letter, every function, constant and sentence about a function is there."""
import re
import sys

header_path, page_path = sys.argv[1:]


def read(path):
    with open(path, encoding="ascii") as file:
        return file.read()


def one_line(text):
    return re.sub(r"\s+", " ", text).strip()


def declarations_of_header(text):
    return {one_line(found) for found in re.findall(r"^TRIBOX_API ([^;]*;)", text, re.M)}


def declarations_of_page(lines):
    """The prototypes between .Ft and .Fn, or .Fo and .Fc, as C."""
    found = set()
    result, name, arguments = "", "", []
    for line in lines:
        macro, _, rest = line.partition(" ")
        words = [quoted or bare for quoted, bare in re.findall(r'"([^"]*)"|(\S+)', rest)]
        if macro == ".Ft":
            result = rest if rest.endswith("*") else rest + " "
        elif macro == ".Fo":
            name, arguments = rest, []
        elif macro == ".Fa":
            arguments += words
        elif macro == ".Fn":
            name, arguments = words[0], words[1:]
        if macro in (".Fn", ".Fc"):
            found.add(f"{result}{name}({', '.join(arguments)});")
    return found


def structs(text):
    return {one_line(found) for found in re.findall(r"^typedef struct .*?^\} \w+;", text, re.M | re.S)}


def difference(what, header, page):
    for text in sorted(header - page):
        yield f"{what} of the header that the page has not: {text}"
    for text in sorted(page - header):
        yield f"{what} of the page that the header has not: {text}"


def words_of_page(text):
    """The words in order, without macros."""
    text = re.sub(r"(?m)^\.(Bl|El|Pp|Bd|Ed)\b.*", "", text)
    return re.findall(r"\w+", re.sub(r"(?m)^\.(It )?([A-Z][a-z] )?", "", text.replace("\\(ha", "^")))


def lost_sentences(header, page):
    """Comments of declarations and members whose words do not stand in the page one after another."""
    words = " ".join(words_of_page(page))
    for comment in re.findall(r"(?<=[;,\d]) +/\* (.*?) \*/$|^/\*\*(.*?)\*/", header, re.M | re.S):
        comment_words = " ".join(re.findall(r"\w+", "".join(comment)))
        if comment_words not in words:
            yield f"comment of the header that the page does not have: {comment_words[:100]}"


text = read(header_path) + read(header_path.replace("tribox.h", "tribox_threads.h"))
header = re.sub(r"/\*.*?\*/", "", text, flags=re.S)
page = read(page_path)
synopsis = re.search(r"^\.Sh SYNOPSIS\n(.*?)^\.Sh ", page, re.M | re.S).group(1)
name_section = re.search(r"^\.Sh NAME\n(.*?)^\.Nd ", page, re.M | re.S).group(1)
prototypes = declarations_of_header(header)
functions = {re.search(r"(\w+)\(", prototype).group(1) for prototype in prototypes}
constants = set(re.findall(r"\b(TRIBOX_[A-Z_]+)\b", header)) - {
    "TRIBOX_H", "TRIBOX_THREADS_H", "TRIBOX_API", "TRIBOX_SHARED", "TRIBOX_SHARED_BUILD"}

faults = []
faults += difference("prototype", prototypes, declarations_of_page(synopsis.splitlines()))
faults += difference("type", structs(header), structs(page))
faults += difference("name", functions, set(re.findall(r"^\.Nm (\w+)", name_section, re.M)) - {"tribox"})
faults += [f"constant of the header that the page does not name: {name}" for name in sorted(constants) if name not in page]
faults += lost_sentences(text, page)
described = page.split(".Sh EXAMPLES")[0]
faults += [f"a comment's mark in the page: {line}" for line in described.splitlines() if re.search(r"/\*|\*/", line)]
faults += [f"type of the header that has no entry: {name}"
           for name in re.findall(r"(?m)^(?:\}|typedef\b[^{;]*?) (\w+)(?:\([^)]*\))?;$", header)
           if f".It Vt {name}\n" not in page and name != "tribox_status"]

for fault in faults:
    print(fault, file=sys.stderr)
print(f"{len(functions)} functions, {len(constants)} constants, {len(structs(header))} types")
sys.exit(1 if faults or not functions else 0)
