"""The C reference, from the public header: its sections, each declaration with what its comment says."""
import html
import re

from public_header import (banner_of, blocks_of, declared_by, is_function, is_type, members, prototype, sections_of, title_of,
                           without_comments)


class CPage:
    def __init__(self, header):
        self.header, self.sections = header, sections_of(header)
        self.names = set()
        for _, entries in self.sections:
            for _, code in entries:
                self.names.update(declared_by(code) + [name for is_variable, name, _ in members(code) if not is_variable])
                self.names.update(re.findall(r"enum \{ (\w+)", code))

    def linked(self, text, around="code"):
        """Text as HTML, where names of the interface are links, and what stands between backticks is code."""
        text = re.sub(r"`([^`]*)`", r"<code>\1</code>", html.escape(text, quote=False))
        marks = (f"<{around}>", f"</{around}>") if around else ("", "")
        return re.sub(r"\b(?:tribox|TRIBOX)_\w+",
                      lambda name: f'<a href="#{name[0]}">{name[0].join(marks)}</a>' if name[0] in self.names else name[0], text)

    def listed(self, rows, name_as="<code>{}</code>"):
        items = "".join(f"<dt{anchor}>{name_as.format(name)}</dt><dd>{self.linked(text)}</dd>\n" for anchor, name, text in rows)
        return f"<dl>\n{items}</dl>\n"

    def declaration(self, code):
        if is_function(code):
            result, name, arguments = prototype(code)
            first = f"{result}{'' if result.endswith('*') else ' '}{name}("
            code = first + ", ".join(arguments) + ");"
            if len(code) > 90:
                code = first + ",\n    ".join(["\n    " + arguments[0], *arguments[1:]]) + ");"
        return f'<pre class="declaration">{self.linked(without_comments(code), None)}</pre>\n'

    def entry(self, comment, code):
        names = declared_by(code) or re.findall(r"enum \{ (\w+)", code) or ["enum"]
        anchors = "".join(f'<span id="{name}"></span>' for name in names[1:])
        anchor = f' id="{names[0]}"' if names[0] != "enum" else ""
        yield f"<h3{anchor}>{anchors}<code>{', '.join(names)}</code></h3>\n" + self.declaration(code)
        for text, about in blocks_of(comment):
            if text:
                yield f"<p>{self.linked(text)}</p>\n"
            if about:
                yield self.listed(("", names, said) for names, said in about)
        said = list(members(code))
        if said:
            yield self.listed(("" if is_variable else f' id="{name}"', name, text) for is_variable, name, text in said)

    def body(self):
        """The page, and what stands beside it."""
        introduction, promise, guarantees = banner_of(self.header)
        parts = [f"<h1>tribox.h</h1>\n<p>{html.escape(title_of(self.header))}.</p>\n<p>{self.linked(introduction)}</p>\n"
                 f"<h2 id=guarantees>{promise}</h2>\n", self.listed((("", name, text) for name, text in guarantees), "{}")]
        contents = [("guarantees", promise, False)]
        for title, entries in self.sections:
            anchor = title.lower().replace(",", "").replace(" ", "-")
            contents.append((anchor, title, False))
            parts.append(f'<h2 id="{anchor}">{title}</h2>\n')
            for comment, code in entries:
                parts.extend(self.entry(comment, code))
                if is_function(code) or is_type(code):
                    contents.extend((name, name, True) for name in declared_by(code))
        return "".join(parts), contents
