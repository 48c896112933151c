#!/usr/bin/env python3
"""The site is whole, leads nowhere that does not exist, and appears all at once or not at all: test_site.py ROOT

It is built with a stand-in for the page of examples/web, and once without. Then faults are put into it, which links.py finds."""
import ast
import html
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
from links import check  # noqa: E402

ROOT = os.path.abspath(sys.argv.pop(1))
sys.path.append(os.path.join(ROOT, "packaging/site"))
from markdown import rendered  # noqa: E402

WITHOUT = {"PAGE": ""}


def built(folder, **environment):
    command = ["sh", os.path.join(ROOT, "packaging/site.sh"), folder]
    return subprocess.run(command, env={**os.environ, **environment}, capture_output=True, text=True)


def read(*path):
    with open(os.path.join(*path), encoding="utf-8") as file:
        return file.read()


def files_below(folder):
    return sorted(os.path.join(where, name) for where, folders, names in os.walk(folder) for name in names
                  if ".git" not in where and not folders.sort())


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.work = cls.temporary.name
        cls.folder = os.path.join(cls.work, "site")
        page = os.path.join(cls.work, "page.html")
        with open(page, "w", encoding="utf-8") as file:
            file.write("<title>stand-in</title>")
        cls.before = files_below(os.path.join(ROOT, "packaging"))
        done = built(cls.folder, PAGE=page)
        if done.returncode:
            raise AssertionError(done.stderr)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_every_link_leads_somewhere(self):
        faults, elsewhere = check(self.folder)
        self.assertEqual(faults, [])
        print("elsewhere:", *elsewhere)

    def test_the_style_loads_nothing(self):
        self.assertNotRegex(read(self.folder, "style.css"), r"@import|url\(")

    def test_the_references_have_every_name(self):
        symbols = subprocess.check_output([os.path.join(ROOT, "packaging/symbols.sh")], text=True).split()
        header = re.sub(r"(?s)/\*.*?\*/", "", read(ROOT, "include/tribox.h"))
        constants = re.findall(r"(?m)^    (TRIBOX_\w+) = |^#define (TRIBOX_VERSION_\w+)", header)
        page = read(self.folder, "reference/c.html")
        self.assertGreater(len(symbols), 40)
        for name in symbols + [one or other for one, other in constants]:
            self.assertIn(f'id="{name}"', page)
        page = read(self.folder, "reference/python.html")
        names = re.search(r"(?s)__all__ = (\[.*?\])", read(ROOT, "python/tribox/__init__.py"))[1]
        for name in ast.literal_eval(names):
            self.assertIn(f'id="{name}"', page)
        page = read(self.folder, "reference/tribox.1.html")
        for command in ("overlap", "voxelize", "sweep", "info", "demo"):
            self.assertIn(f"tribox {command}", page)

    def test_comments_are_taken_whole(self):
        page = read(self.folder, "reference/c.html")
        self.assertNotRegex(page, r"\*/|/\*")
        words = " ".join(re.findall(r"\w+", html.unescape(re.sub(r"<[^>]*>", " ", page))))
        comments = re.findall(r"(?ms)(?<=[;,\d]) +/\* ([^\n]*?) \*/$|^/\*\*(.*?)\*/", read(ROOT, "include/tribox.h"))
        self.assertGreater(len(comments), 100)
        for comment in comments:
            for paragraph in re.split(r"\n \*\n", "".join(comment)):
                self.assertIn(" ".join(re.findall(r"\w+", paragraph)), words)

    def test_headings_of_one_name_have_two_anchors(self):
        markup = rendered("# A\n\n## B, c\n\n## B, `c`\n")
        self.assertEqual(re.findall(r'<h\d id="(.*?)">', markup), ["a", "b-c", "b-c-1"])

    def test_a_page_that_is_not_there_is_not_linked(self):
        folder = os.path.join(self.work, "without")
        done = built(folder, **WITHOUT)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("without the page", done.stdout)
        self.assertEqual(check(folder)[0], [])
        self.assertNotIn('<a href="try.html"', read(folder, "index.html"))
        self.assertIn('<a href="try.html"', read(self.folder, "index.html"))

    def test_the_source_is_left_alone(self):
        self.assertEqual(files_below(os.path.join(ROOT, "packaging")), self.before)

    def test_a_folder_with_files_is_refused(self):
        folder = os.path.join(self.work, "taken")
        os.mkdir(folder)
        with open(os.path.join(folder, "mine"), "w", encoding="utf-8"):
            pass
        done = built(folder, **WITHOUT)
        self.assertNotEqual(done.returncode, 0)
        self.assertRegex(done.stderr, r"\Asite.sh: .*taken is there already: remove it.*\n\Z")
        self.assertEqual(os.listdir(folder), ["mine"])

    def test_where_a_part_fails_nothing_appears(self):
        programs = os.path.join(self.work, "programs")
        os.mkdir(programs)
        with open(os.path.join(programs, "mandoc"), "w", encoding="utf-8") as file:
            file.write("#!/bin/sh\nexit 1\n")
        os.chmod(os.path.join(programs, "mandoc"), 0o755)
        os.mkdir(os.path.join(self.work, "empty"))
        done = built(os.path.join(self.work, "empty", "site"), PATH=programs + ":" + os.environ["PATH"], **WITHOUT)
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(os.listdir(os.path.join(self.work, "empty")), [])
        done = built(os.path.join(self.work, "empty", "site"), PAGE="/nowhere/page.html")
        self.assertNotEqual(done.returncode, 0)
        self.assertEqual(os.listdir(os.path.join(self.work, "empty")), [])

    def test_faults_are_found(self):
        bench = "bench/index.html"
        faults = {
            "no such page": (bench, lambda text: text.replace('href="scale.html"', 'href="scales.html"', 1).replace(
                'href="order/order.html"', 'href="order/orders.html"', 1), "does not exist"),
            "no such place": (bench, lambda text: text.replace('id="recorded-figures"', 'id="recorded"'), "names no place"),
            "no such picture": (bench, lambda text: text.replace('trade.svg"', 'traded.svg"'), "does not exist"),
            "twice": (bench, lambda text: text.replace("</main>", '<p id="contestants"></p></main>'), "twice"),
            "no bar": (bench, lambda text: text.replace('class="bar"', ""), "no bar"),
            "two titles": (bench, lambda text: text.replace("</h1>", "</h1><h1></h1>"), "2 of <h1>"),
            "from elsewhere": (bench, lambda text: text.replace('src="results', 'src="https://example.org/results', 1), "is loaded"),
            "a script": (bench, lambda text: text.replace("</main>", "<script></script></main>"), "<script>"),
            "alone": ("alone.html", lambda text: text, "no page leads to it"),
        }
        for name, (path, change, expected) in faults.items():
            full = os.path.join(self.folder, path)
            before = read(full) if os.path.exists(full) else None
            changed = change(before or read(self.folder, "index.html"))
            self.assertNotEqual(changed, before, name)
            with open(full, "w", encoding="utf-8") as file:
                file.write(changed)
            found = check(self.folder)[0]
            self.assertTrue(any(expected in fault for fault in found), f"{name}: {found}")
            if before is None:
                os.remove(full)
            else:
                with open(full, "w", encoding="utf-8") as file:
                    file.write(before)
        self.assertEqual(check(self.folder)[0], [])

    def test_a_broken_link_of_the_source_is_named(self):
        copy = os.path.join(self.work, "source")
        shutil.copytree(ROOT, copy, ignore=shutil.ignore_patterns(".*", "build", "build-*"))
        with open(os.path.join(copy, "README.md"), "w", encoding="utf-8") as file:
            file.write("# tribox\n\n[Nothing](nothing.md)\n")
        done = subprocess.run(["sh", os.path.join(copy, "packaging/site.sh"), os.path.join(self.work, "broken")],
                              env={**os.environ, **WITHOUT}, capture_output=True, text=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("README.md: links to nothing.md, which does not exist", done.stderr)
        self.assertFalse(os.path.exists(os.path.join(self.work, "broken")))


if __name__ == "__main__":
    for program in ("cmark-gfm", "mandoc"):
        if not shutil.which(program):
            print(f"no {program}: skipped")
            sys.exit(77)
    unittest.main(verbosity=2)
