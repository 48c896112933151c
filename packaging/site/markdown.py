"""Pages from the Markdown of the repository, beginning with README.md and following every link to a file: to other Markdown, to
pictures, to sources and folders, which become pages of their own."""
import html
import itertools
import os
import posixpath
import re
import shutil
import subprocess

from look import plain, read, relative

PICTURES = (".png", ".svg")
SOURCES = (".c", ".cc", ".h", ".js", ".mjs", ".py", ".sh")


def rendered(text):
    """As GitHub would: cmark-gfm, and an anchor for every heading."""
    command = ["cmark-gfm", "-e", "table", "-e", "autolink", "-e", "strikethrough"]
    markup = subprocess.run(command, input=text, capture_output=True, text=True, check=True).stdout
    used = {}

    def with_anchor(match):
        level, name = match.groups()
        anchor = re.sub(r"[^\w\- ]", "", plain(name).lower()).replace(" ", "-")
        used[anchor] = used.get(anchor, -1) + 1
        anchor += f"-{used[anchor]}" if used[anchor] else ""
        return f'<h{level} id="{anchor}">{name}</h{level}>'

    markup = re.sub(r"<h([1-6])>(.*?)</h\1>", with_anchor, markup, flags=re.S)
    return markup.replace("<table>", '<div class="wide"><table>').replace("</table>", "</table></div>")


class Tree:
    """The files of the repository that the pages of a site link to, first of all README.md."""

    def __init__(self, root, site, c_page, c_names):
        self.root, self.site, self.c_page, self.c_names = root, site, c_page, c_names
        self.seen, self.waiting = set(), []

    def full(self, path):
        return os.path.join(self.root, path)

    def page_of(self, path):
        """Where a file of the repository is in the site."""
        if os.path.isdir(self.full(path)):
            return posixpath.join(path, "index.html")
        folder, name = posixpath.split(path)
        if name == "README.md":
            return posixpath.join(folder, "index.html")
        if name.endswith(".md"):
            return path[:-3] + ".html"
        return path if name.endswith(PICTURES) or not self.is_text(path) else path + ".html"

    def is_text(self, path):
        try:
            read(self.full(path))
        except UnicodeDecodeError:
            return False
        return True

    def link(self, target, source, page):
        """The address in the site of what a file of the repository, and page of the site, links to."""
        if re.match(r"[a-z]+:|#", target):
            return target
        path, mark, anchor = target.partition("#")
        path = posixpath.normpath(posixpath.join(posixpath.dirname(source), path))
        if path.startswith("..") or not os.path.exists(self.full(path)):
            raise SystemExit(f"{source}: links to {target}, which does not exist")
        self.want(path)
        return relative(self.page_of(path), page) + mark + anchor

    def want(self, path):
        if path not in self.seen:
            self.seen.add(path)
            self.waiting.append(path)

    def follow(self, *paths):
        """Makes the pages of these files, and of all that they link to."""
        for path in paths:
            self.want(path)
        while self.waiting:
            self.make(self.waiting.pop())

    def make(self, path):
        if os.path.isdir(self.full(path)):
            if os.path.exists(self.full(posixpath.join(path, "README.md"))):
                self.want(posixpath.join(path, "README.md"))
            else:
                self.make_folder(path)
        elif path.endswith(".md"):
            self.make_markdown(path)
        elif path.endswith(PICTURES) or not self.is_text(path):
            shutil.copyfile(self.full(path), self.site.file(path))
        else:
            text = html.escape(read(self.full(path)), quote=False)
            self.site.add(self.page_of(path), path, f"<h1>{path}</h1>\n<pre>{text}</pre>")

    def make_markdown(self, path):
        page = self.page_of(path)
        markup = rendered(read(self.full(path)))
        markup = re.sub(r'(href|src)="([^"]*)"',
                        lambda match: f'{match[1]}="{html.escape(self.link(html.unescape(match[2]), path, page))}"', markup)
        markup = re.sub(r"(?<!\">)<code>(\w+)</code>(?!</a>)", lambda match: self.with_reference(match, page), markup)
        headings = re.findall(r'<h([12]) id="([^"]*)">(.*?)</h', markup, re.S)
        title = next((plain(name) for level, _, name in headings if level == "1"), path)
        contents = [(anchor, re.sub(r"</?a\b[^>]*>", "", name), False) for level, anchor, name in headings if level == "2"]
        self.site.add(page, title, markup, contents)

    def with_reference(self, match, page):
        """Names of the interface lead to the C reference."""
        if match[1] not in self.c_names:
            return match[0]
        return f'<a href="{relative(self.c_page, page)}#{match[1]}">{match[0]}</a>'

    def make_folder(self, path):
        page, rows = self.page_of(path), []
        for name in sorted(os.listdir(self.full(path))):
            inner = posixpath.join(path, name)
            if name.startswith((".", "__pycache__")):
                continue
            about = self.about(inner)
            href = html.escape(self.link(name, posixpath.join(path, "index"), page))
            rows.append(f'<tr><td><a href="{href}">{name}{"/" * os.path.isdir(self.full(inner))}</a></td><td>{about}</td></tr>')
        table = "\n".join(rows)
        self.site.add(page, path, f'<h1>{path}</h1>\n<div class="wide"><table>\n{table}\n</table></div>')

    def about(self, path):
        """The first sentence of what a source says it is for."""
        if not path.endswith(SOURCES):
            return ""
        comment = re.match(r"(?:#![^\n]*\n)?(/\*.*?\*/|\"\"\".*?\"\"\"|(?:(?:#|//)[^\n]*\n)+)", read(self.full(path)), re.S)
        lines = [line.strip(' /*#"') for line in comment[1].split("\n")] if comment else []
        text = " ".join(itertools.takewhile(bool, itertools.dropwhile(lambda line: not line, lines)))
        return html.escape(re.split(r"(?<=[.?!]) (?=[A-Z])", re.sub(r"^[\w.-]+ - ", "", text))[0], quote=False)
