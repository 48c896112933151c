#!/usr/bin/env python3
"""Every link, picture and style of a site leads somewhere: links.py FOLDER

Each page has a title, one heading of the first level, the bar, no script and no anchor twice, and loads nothing from elsewhere; each
file can be reached from index.html. Links to what lies outside the site are not followed, but listed."""
import html.parser
import os
import posixpath
import sys
import urllib.parse

OWN = {"try.html"}  # the page of examples/web, which has a look of its own
ELSEWHERE = ("http:", "https:", "mailto:")


class Page(html.parser.HTMLParser):
    def __init__(self, text):
        super().__init__()
        self.anchors, self.links, self.loaded, self.tags, self.has_bar = [], [], [], [], False
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        attrs = dict(attrs)
        self.tags.append(tag)
        self.has_bar |= tag == "nav" and attrs.get("class") == "bar"
        self.anchors += [attrs["id"]] if attrs.get("id") else []
        self.loaded += [attrs["src"]] if attrs.get("src") else [attrs["href"]] if tag == "link" else []
        self.links += [attrs[name] for name in ("href", "src") if attrs.get(name) is not None]


def files_of(folder):
    for where, _, names in os.walk(folder):
        for name in names:
            yield posixpath.normpath(posixpath.join(os.path.relpath(where, folder), name))


def faults_of_page(path, page):
    for tag in ("title", "h1"):
        if page.tags.count(tag) != 1:
            yield f"{path}: {page.tags.count(tag)} of <{tag}>"
    for tag in sorted({"script", "iframe", "object"}.intersection(page.tags)):
        yield f"{path}: <{tag}>"
    for address in page.loaded:
        if address.startswith(ELSEWHERE):
            yield f"{path}: {address} is loaded"
    if not page.has_bar:
        yield f"{path}: no bar"
    for anchor in sorted({anchor for anchor in page.anchors if page.anchors.count(anchor) > 1}):
        yield f"{path}: the anchor {anchor} stands there twice"


def check(folder):
    """(faults, addresses elsewhere)"""
    files, faults, elsewhere = set(files_of(folder)), [], set()
    pages = {}
    for path in sorted(files):
        if path.endswith(".html") and path not in OWN:
            with open(os.path.join(folder, path), encoding="utf-8") as file:
                pages[path] = Page(file.read())
            faults += faults_of_page(path, pages[path])
    reached = {"index.html"}
    waiting = ["index.html"]
    while waiting:
        path = waiting.pop()
        for link in pages[path].links if path in pages else []:
            if link.startswith(ELSEWHERE):
                elsewhere.add(link)
                continue
            if link.startswith("data:"):
                continue
            target, _, anchor = link.partition("#")
            target = posixpath.normpath(posixpath.join(posixpath.dirname(path), urllib.parse.unquote(target))) if target else path
            if target not in files:
                faults.append(f"{path}: {link} does not exist")
            elif anchor and (target not in pages or urllib.parse.unquote(anchor) not in pages[target].anchors):
                faults.append(f"{path}: {link} names no place in {target}")
            if target in files and target not in reached:
                reached.add(target)
                waiting.append(target)
    return faults + [f"{path}: no page leads to it" for path in sorted(files - reached)], sorted(elsewhere)


def main(folder):
    if not os.path.exists(os.path.join(folder, "index.html")):
        sys.exit(f"{folder}: there is no index.html")
    faults, elsewhere = check(folder)
    for fault in faults:
        print(fault, file=sys.stderr)
    for address in elsewhere:
        print(f"elsewhere: {address}")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main(sys.argv[1])
