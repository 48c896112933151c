"""The frame that every page of the site has, and the folder that the pages are in until all are written."""
import html
import os
import posixpath
import re

HERE = os.path.dirname(os.path.abspath(__file__))
BAR = [
    ("tribox", "index.html"), ("Try it", "try.html"), ("C", "reference/c.html"), ("Python", "reference/python.html"),
    ("JavaScript", "packaging/npm/index.html"), ("Program", "reference/tribox.1.html"), ("Benchmarks", "bench/index.html"),
    ("Orders", "bench/order/findings.html"), ("Scale", "bench/scale.html"), ("Insides", "examples/insides/index.html"),
    ("Proofs", "src/kernel/PROOFS.html"), ("Changes", "CHANGELOG.html"), ("Contributing", "CONTRIBUTING.html"),
]


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def plain(markup):
    """The text of HTML."""
    return html.unescape(re.sub(r"<[^>]*>", "", markup)).strip()


def relative(target, page):
    """The address of one page of the site from another."""
    return posixpath.relpath(target, posixpath.dirname(page) or ".")


class Site:
    def __init__(self, folder):
        self.folder, self.pages, self.template = folder, {}, read(os.path.join(HERE, "template.html"))

    def add(self, path, title, body, contents=()):
        """contents: (anchor, HTML, whether it belongs to one before) of what stands beside the page."""
        self.pages[path] = (title, body, contents)

    def file(self, path):
        """Where to write a file of the site."""
        full = os.path.join(self.folder, path)
        os.makedirs(os.path.dirname(full), exist_ok=True)
        return full

    def has(self, path):
        return path in self.pages or os.path.exists(os.path.join(self.folder, path))

    def write(self, version):
        for path, (title, body, contents) in self.pages.items():
            bar = "".join(
                f'<a href="{relative(target, path)}"{" aria-current=page" * (target == path)}>{label}</a>'
                for label, target in BAR if self.has(target))
            beside = "".join(f'<a href="#{anchor}"{" class=inner" * inner}>{name}</a>\n' for anchor, name, inner in contents)
            parts = {
                "title": html.escape(title if title == "tribox" else f"{title} - tribox"), "bar": bar, "body": body,
                "version": version, "top": posixpath.relpath(".", posixpath.dirname(path) or ".") + "/",
                "contents": f'<nav class="contents" aria-label="On this page">\n{beside}</nav>\n' if len(contents) > 2 else "",
            }
            with open(self.file(path), "w", encoding="utf-8") as file:
                file.write(re.sub(r"\{(\w+)\}", lambda match: parts[match[1]], self.template))
