#!/usr/bin/env python3
"""The manual page of the header says what the header says: manual.py HEADER PAGE SYMBOLS

Prototypes and types agree to the letter, every exported function and every constant is named."""
import re
import sys

header_path, page_path, symbols_path = sys.argv[1:]


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


header = re.sub(r"/\*.*?\*/", "", read(header_path), flags=re.S)
page = read(page_path)
synopsis = re.search(r"^\.Sh SYNOPSIS\n(.*?)^\.Sh ", page, re.M | re.S).group(1)
name_section = re.search(r"^\.Sh NAME\n(.*?)^\.Nd ", page, re.M | re.S).group(1)
symbols = set(read(symbols_path).split())
constants = set(re.findall(r"\b(TRIBOX_[A-Z_]+)\b", header)) - {"TRIBOX_H", "TRIBOX_API", "TRIBOX_SHARED", "TRIBOX_SHARED_BUILD"}

faults = []
faults += difference("prototype", declarations_of_header(header), declarations_of_page(synopsis.splitlines()))
faults += difference("type", structs(header), structs(page))
faults += difference("name", symbols, set(re.findall(r"^\.Nm (\w+)", name_section, re.M)) - {"tribox"})
faults += difference("constant", constants, set(re.findall(r"\b(TRIBOX_[A-Z_]+)\b", page)))
faults += [f"symbol that the header does not declare: {name}" for name in sorted(symbols) if f"{name}(" not in header]

for fault in faults:
    print(fault, file=sys.stderr)
print(f"{len(symbols)} functions, {len(constants)} constants, {len(structs(header))} types")
sys.exit(1 if faults else 0)
