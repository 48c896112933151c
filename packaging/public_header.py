"""Takes include/tribox.h apart for its manual page, made by man3.py beside this file.

The header is written so that this is simple. A comment that begins at the left edge belongs to the declaration after it; in it,
"name: ..." is about a parameter, and an empty line ends a paragraph. Comments at the end of a line are about a member. The comment
at the top has a table of what holds for every function, and a title between two rules opens a section."""

import os
import re


def read_headers(path):
    """include/tribox.h at this path, and after it what the headers beside it declare."""
    text = ""
    for name in ("tribox.h", "tribox_threads.h"):
        with open(os.path.join(os.path.dirname(path), name), encoding="ascii") as file:
            header = file.read()
        text += header if not text else header[header.index("/* ="):]
    return text


PART = re.compile(r"""^/\*\ =+\ \*/\n/\*\ +(?P<title>.*?)\ +\*/\n/\*\ =+\ \*/$
                    | ^/\*\*(?P<comment>.*?)\*/\n(?P<code>(?:\#define[^\n]*\n)+ | TRIBOX_API[^;]*;$ | typedef[^;]*?\{.*?^\}[^;]*;
                                                         | typedef[^;{]*;$ | enum\ \{[^}]*\};)""",
                  re.M | re.S | re.X)


def title_of(header):
    return re.match(r"/\*\n \* tribox\.h - (.*)", header)[1]


def banner_of(header):
    """The comment at the top: what comes before its table, the title of the table, and its rows, a name and a text each."""
    banner = header[:header.index("*/")]
    introduction, promise = re.search(r"\n \*\n(.*?)\n \*\n \* ([^\n]*)\n", banner, re.S).groups()
    rows = re.findall(r"(?m)^ \*   (\w.*?) {2,}(.*(?:\n \* {5,}.*)*)", banner)
    return introduction.replace("\n *", " ").strip(" *"), promise, [(name, text.replace("\n *", " ")) for name, text in rows]


def sections_of(header):
    """(title, list of (comment, declaration)) for each section. A comment without a declaration opens that of the next."""
    sections = [("Version", [])]
    for part in PART.finditer(header):
        if part["title"]:
            sections.append((part["title"], []))
        else:
            comment = re.sub(r"\s*\*/\s*/\*\*\s*", "\n *\n * ", part["comment"])
            sections[-1][1].append((comment, part["code"].strip()))
    return sections


def blocks_of(comment):
    """The paragraphs of a comment: a text, which may be empty, and a list of (parameters, text) that follows it."""
    for block in re.split(r"\n\s*\n", re.sub(r"(?m)^ \*( |$)", "", comment).strip()):
        about = re.split(r"(?m)^([a-z]+(?:, [a-z]+)*): ", block)
        yield about[0].strip(), list(zip(about[1::2], about[2::2]))


def is_function(code):
    return code.startswith("TRIBOX_API")


def is_type(code):
    return code.startswith(("typedef", "enum"))


def function_of(code):
    return re.search(r"(\w+)\(", code)[1]


def declared_by(code):
    """The names that a declaration gives to a page: of a function, of a type, of macros; none for an enum without a name."""
    if is_function(code):
        return [function_of(code)]
    if code.startswith("#define"):
        return re.findall(r"#define (\w+)", code)
    if code.startswith("typedef"):
        return [re.search(r"(\w+)(?:\([^)]*\))?;$", code)[1]]
    return []


def prototype(code):
    """(what a function returns, its name, its arguments)"""
    result, name, arguments = re.match(r"TRIBOX_API (.*?)(\w+)\((.*)\);", " ".join(code.split())).groups()
    return result.strip(), name, arguments.split(", ")


def members(code):
    """(whether it is a variable, name, text) of the members of a struct, or the constants of an enum, that have a comment."""
    for line in code.split("\n"):
        member = re.match(r"    ([^;]*?)(\w+)([\[\]\d]*)(?: = \d+)?[;,]? +/\* (.*) \*/$", line)
        if member:
            yield bool(member[1]), member[2], member[4]


def without_comments(code):
    return re.sub(r" */\*.*?\*/", "", code)
