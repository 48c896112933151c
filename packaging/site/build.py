#!/usr/bin/env python3
"""Writes the pages of the site into an empty folder: build.py ROOT FOLDER. Called by packaging/site.sh."""
import os
import re
import shutil
import subprocess
import sys

root, folder = sys.argv[1:]
sys.path.insert(1, os.path.join(root, "packaging"))

from c_page import CPage  # noqa: E402
from look import HERE, Site, plain, read  # noqa: E402
from markdown import Tree  # noqa: E402
from public_header import read_headers  # noqa: E402
from python_page import PythonPage  # noqa: E402

C, PYTHON, PROGRAM = "reference/c.html", "reference/python.html", "reference/tribox.1.html"
# What the bar leads to, and README.md, which leads to all else.
MARKDOWN = ["README.md", "BUILD.md", "CHANGELOG.md", "CONTRIBUTING.md", "examples/README.md", "examples/shell.md",
            "bench/README.md", "bench/scale.md", "bench/order/findings.md", "examples/insides/README.md",
            "packaging/npm/README.md", "src/kernel/PROOFS.md"]


def manual():
    """tribox(1), its headings one level lower, as every page has one of the first."""
    command = ["mandoc", "-T", "html", "-O", "fragment", os.path.join(root, "tools/tribox.1")]
    markup = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    markup = re.sub(r'<table class="(?:head|foot)">.*?</table>', "", markup, flags=re.S)
    markup = re.sub(r"(</?h)([12])", lambda match: match[1] + str(int(match[2]) + 1), markup)
    headings = re.findall(r'<h([23])[^>]* id="([^"]*)">(.*?)</h', markup, re.S)
    return "<h1>tribox(1)</h1>\n" + markup, [(anchor, in_contents(plain(name)), level == "3") for level, anchor, name in headings]


def in_contents(name):
    """What a manual has in capitals, in lower case; the name of the program has no capital."""
    name = name.capitalize() if name.isupper() else name
    return name.replace("Tribox", "tribox")


site = Site(folder)
shutil.copyfile(os.path.join(HERE, "style.css"), site.file("style.css"))
c_page = CPage(read_headers(os.path.join(root, "include/tribox.h")))
site.add(C, "C reference", *c_page.body())
site.add(PYTHON, "Python reference", *PythonPage(os.path.join(root, "python/tribox")).body())
site.add(PROGRAM, "tribox(1)", *manual())
Tree(root, site, C, c_page.names).follow(*MARKDOWN)
site.write(".".join(re.findall(r"#define TRIBOX_VERSION_\w+ +(\d+)", c_page.header)))
print(f"{len(site.pages)} pages")
