#!/usr/bin/env python3
"""Makes the manual page tribox(1) of what the program's help says and of a text that has the rest: manual.py PROGRAM TEXT PAGE

"# TITLE" begins a section, an empty line a paragraph; "| " stands before lines that stay as they are, and "- TERM" before an item,
whose lines are indented. "# tribox COMMAND" begins with what the help of the command says, and ends with its options and examples;
an item there is what else there is to say of an option. *Words* are bold, and so are options. {labels} are the formats that hold
labels, as 'tribox info --json' lists them, and {faces} those of that kind; under FORMATS each of them has an item."""
import json
import re
import subprocess
import sys

HEAD = r""".\" Made by tools/manual.py of tools/manual.txt and the program's help.
.Dd November 25, 2026
.Dt TRIBOX 1
.Os tribox"""
OPTION = re.compile(r"^ {2,6}((?:-\w, )?--[\w-]+(?: \S+)?) {2,}(.*(?:\n {10,}\S.*)*)", re.M)


def inline(text):
    """A line of roff, or of a paragraph a line for each sentence."""
    text = text.replace("\\", r"\e")
    text = re.sub(r"\*(\S(?:[^*]*?\S)?)\*(?!\w)", r"\\fB\1\\fR", text)
    text = re.sub(r"(?<![\w\\-])--?[a-z][a-z-]*(?!\w)", lambda found: r"\fB" + found[0].replace("-", r"\-") + r"\fR", text)
    return re.sub(r"(?m)^(?=[.'])", r"\\&", text)


def joined(text):
    return re.sub(r"(?<!\b[A-Z])\. ", ".\n", " ".join(text.split()))


class page:
    def __init__(self, program):
        self.program, self.lines, self.is_fresh = program, [HEAD], True

        self.formats = json.loads(self.run("info", "--json"))["formats"]

    def run(self, *words):
        return subprocess.run([self.program, *words], check=True, capture_output=True, encoding="ascii").stdout

    def help(self, command):
        return self.run("help", *command)

    def named(self, found):
        """The formats that hold something, or of a kind."""
        names = [self.name(each) for each in self.formats if found[1] in (each["kind"], *re.findall(r"\w+", each["holds"]))]
        assert names, f"no format holds {found[1]}"
        return ", ".join(names[:-1]) + " and " * (len(names) > 1) + names[-1]

    def name(self, of):
        """Its ending, or its word where another has that ending."""
        return of["ending"] if of["ending"] == "." + of["word"] else f"*{of['word']}*"

    def put(self, *lines, is_fresh=True):
        self.lines += lines
        self.is_fresh = is_fresh  # nothing stands above: no empty line is due

    def paragraphs(self, text):
        """Text and lines that stay, with an empty line between paragraphs."""
        for block in re.split(r"\n\s*\n", text.strip("\n")):
            for literal, lines in re.findall(r"^( *\| .*(?:\n *\| .*)*)|^((?! *\| ).+(?:\n(?! *\| ).+)*)", block, re.M):
                if literal:
                    kept = [inline(line.split("| ", 1)[1]) for line in literal.split("\n")]
                    self.put(".Bd -literal -offset indent", *kept, ".Ed", is_fresh=False)
                elif lines.strip():
                    self.put(*([] if self.is_fresh else [".Pp"]), inline(joined(lines)), is_fresh=False)

    def items(self, items):
        if items:
            self.put(".Bl -tag -width Ds")
        for term, text in items:
            self.put(".It " + term)
            self.paragraphs(text)
        if items:
            self.put(".El", is_fresh=False)

    def command(self, name, text, more):
        blocks = self.help([name]).split("\n\n")[2:]
        for block in blocks:
            if not OPTION.search(block) and not re.match("Exit codes|Example", block):
                self.paragraphs(block)
        self.paragraphs(text)
        items = []
        for head, about in OPTION.findall("\n\n".join(blocks)):
            words = re.split(r"(?<!,) ", head)
            extra = more.pop(re.search("--[a-z-]+", head)[0], "")
            value = r" \fI" + words[1] + r"\fR" if len(words) > 1 else ""
            items.append((inline(words[0]) + value, joined(about) + ".\n" + extra))
        assert not more, f"the help of {name} has no {', '.join(more)}"
        self.items(items)
        self.paragraphs("\n".join(["For example:"] + ["| " + line.strip() for line in blocks[-1].strip().split("\n")[1:]]))

    def section(self, title, text):
        body, *items = re.split(r"^- ", text, flags=re.M)
        items = [item.partition("\n")[::2] for item in items]
        if title == "FORMATS":
            told = {name for term, _ in items for name in term.split(", ")}
            rest = [each for each in self.formats if self.name(each) not in told]
            items += [(self.name(each), f"{each['about']}: {each['holds']}.") for each in rest]
        self.put(".Sh " + title.upper())
        if title.startswith("tribox "):
            self.command(title.split()[1], body, dict(items))
        else:
            self.paragraphs(body)
            self.items([(inline(term), about) for term, about in items])


def main(program, text_path, page_path):
    made = page(program)
    general = made.help([])
    made.put(".Sh NAME", ".Nm tribox", ".Nd " + general.split("\n")[0].split(" - ")[1], ".Sh SYNOPSIS")
    for command in re.findall(r"^  (\w+)  ", general.split("Commands:")[1].split("\n\n")[0], re.M):
        for use in re.findall(r"(?<=tribox )\w.*", made.help([command]).split("\n\n")[1]):
            made.put(".Nm tribox", inline(use))
    for use in re.findall(r"(?<=tribox )\w.*|(?<=tribox )--.*", general.split("\n\n")[1])[1:]:
        made.put(".Nm tribox", inline(use))
    with open(text_path, encoding="ascii") as file:
        text = re.sub(r"\{(\w+)\}", made.named, file.read())
        for section in re.split(r"^# ", text, flags=re.M)[1:]:
            made.section(*section.split("\n", 1))
    with open(page_path, "w", encoding="ascii") as file:
        file.write("\n".join(made.lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
