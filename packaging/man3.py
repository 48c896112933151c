#!/usr/bin/env python3
"""Makes the manual page tribox(3) from the public header and the example in README.md: man3.py HEADER README PAGE

The header is written so that this is simple. A comment that begins at the left edge belongs to the declaration after it; in it,
"name: ..." is about a parameter, and an empty line ends a paragraph. Comments at the end of a line are about a member. The comment
at the top has a table of what holds for every function, and a title between two rules opens a section."""

import os
import re
import sys

DATE = "November 22, 2026"  # when the interface last changed

HEAD = r"""
.\" Made by packaging/man3.py from include/tribox.h, which is the place to edit.
.Dd {date}
.Dt TRIBOX 3
.Os tribox
.Sh NAME
{names}
.Nd {title}
.Sh LIBRARY
libtribox
.Pq -ltribox
.Sh SYNOPSIS
.In tribox.h
"""

RETURNS = "Most functions return a tribox_status. The others return what they count or name, as described above."

EXAMPLES = r"""
.Sh EXAMPLES
{code}
.Pp
Compile it with
.Dl cc example.c $(pkg-config --cflags --libs tribox)
.Sh SEE ALSO
.Xr tribox 1
.Rs
.%A T. Akenine-Moller
.%T Fast 3D Triangle-Box Overlap Testing
.%J Journal of Graphics Tools
.%D 2001
.Re
"""

WORD = re.compile(r"(?<!\S)(TRIBOX_\w+|NULL|tribox_\w+)([.,;:]*)(?!\S)")


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


def declared_by(code):
    """The names that a declaration gives to a page: of a function, of a type, of macros; none for an enum without a name."""
    if is_function(code):
        return [re.search(r"(\w+)\(", code)[1]]
    if code.startswith("#define"):
        return re.findall(r"#define (\w+)", code)
    if code.startswith("typedef"):
        return [re.search(r"(\w+)(?:\([^)]*\))?;$", code)[1]]
    return []


def escaped(text):
    """Text as roff, on lines of its own."""
    text = text.replace("\\", "\\e").replace("^", "\\(ha").replace("~", "\\(ti").replace("`", "")
    return re.sub(r"(?m)^([.'])", r"\\&\1", text)


def marked(match):
    word, after = match.groups()
    macro = "Dv" if word.isupper() else "Vt" if word in types else "Fn"
    return f"\n.{macro} {word} {' '.join(after)}".rstrip() + "\n"


def prose(text):
    """A paragraph, each sentence on a new line, with the interface's names marked."""
    sentences = re.sub(r"(?<=[a-z0-9)\]*][.:;?]) (?=[A-Z])", "\n", " ".join(text.split()))
    lines = (line.strip() for line in WORD.sub(marked, escaped(sentences)).split("\n"))
    return "\n".join(line for line in lines if line)


def literal(code):
    return f".Bd -literal -offset indent\n{escaped(code.rstrip())}\n.Ed"


def listed(items):
    """A list of (macro and name, text)."""
    return "\n".join([".Bl -tag -width Ds", *(f".It {name}\n{prose(text)}" for name, text in items), ".El"])


def paragraphs(comment):
    """The paragraphs of a comment: a text, or a list of what is said about parameters."""
    for text, about in blocks_of(comment):
        if text:
            yield prose(text)
        if about:
            yield listed((f"Fa {names.replace(', ', ' , ')}", said) for names, said in about)


def joined(blocks):
    """Blocks as paragraphs. Lists and code make room for themselves."""
    blocks = list(blocks)
    return "\n".join(block if number == 0 or block.startswith((".Bl", ".Bd")) else ".Pp\n" + block for number,
                     block in enumerate(blocks))


def synopsis(code):
    result, name, arguments = re.match(r"TRIBOX_API (.*?)(\w+)\((.*)\);", " ".join(code.split())).groups()
    return "\n".join([f".Ft {result.strip()}", f".Fo {name}", *(f'.Fa "{each}"' for each in arguments.split(", ")), ".Fc"])


def said_of_members(code):
    """(macro and name, text) of the members of a struct, or the constants of an enum, that have a comment."""
    found = re.findall(r"(?m)^    ([^;\n]*?)(\w+)[\[\]\d]*(?: = \d+)?[;,]? +/\* (.*) \*/$", code)
    return [(f"{'Va' if is_variable else 'Dv'} {name}", text) for is_variable, name, text in found]


def described(comment, code):
    """The declaration and its comment, as an entry of a section."""
    names = declared_by(code)
    if is_function(code):
        heading = f".It Fn {names[0]}"
    elif code.startswith("#define"):
        heading = ".It Xo\n" + "\n".join(f".Dv {name}" for name in names) + "\n.Xc"
    else:
        heading = f".It Vt {names[0] if names else 'enum'}"
    blocks = list(paragraphs(comment))
    said = said_of_members(code)
    if code.startswith(("typedef", "enum")) and not ("enum" in code and said):
        blocks.append(literal(re.sub(r" */\*.*?\*/", "", code)))
    if said:
        blocks.append(listed(said))
    return f"{heading}\n{joined(blocks)}"


def page_of(header, example):
    introduction, promise, guarantees = banner_of(header)
    sections = sections_of(header)
    declared = [entry for _, entries in sections for entry in entries]
    status = next(entry for entry in declared if entry[1].endswith("} tribox_status;"))
    names = ["tribox", *(name for _, code in declared if is_function(code) for name in declared_by(code))]

    yield HEAD.strip().format(date=DATE, title=re.match(r"/\*\n \* tribox\.h - (.*)", header)[1],
                              names=" ,\n".join(f".Nm {name}" for name in names))
    for title, entries in sections:
        calls = [synopsis(code) for _, code in entries if is_function(code)]
        if calls:
            yield "\n".join([f".Ss {title}", *calls])
    yield f".Sh DESCRIPTION\n{prose(introduction)}\n.Ss {promise}\n{listed(guarantees)}"
    for title, entries in sections:
        yield "\n".join([f".Ss {title}", ".Bl -tag -width Ds", *(described(*entry) for entry in entries if entry is not status),
                         ".El"])
    yield f".Sh RETURN VALUES\n{prose(RETURNS)}\n.Pp\n{joined(paragraphs(status[0]))}\n{listed(said_of_members(status[1]))}"
    yield EXAMPLES.strip().format(code=literal(example))


header_path, readme_path, page_path = sys.argv[1:]
public_header = read_headers(header_path)
types = set(re.findall(r"(?m)^\} (\w+);$", public_header))
with open(readme_path, encoding="utf-8") as readme:
    first_example = re.search(r"```c\n((?:(?!```).)*int main.*?)```", readme.read(), re.S)[1]
with open(page_path, "w", encoding="ascii") as page:
    page.write("\n".join(page_of(public_header, first_example)) + "\n")
