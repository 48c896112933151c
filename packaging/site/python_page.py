"""The Python reference, from the docstrings of the package; nothing is imported, so it needs neither NumPy nor the library."""
import ast
import html
import os
import re
import textwrap

from look import read


def rendered(docstring, function=None):
    """Paragraphs, sessions of Python, and lists of what is said about the arguments of a function."""
    name = "|".join(argument.arg for argument in arguments_of(function)) if function else r"\w+"
    start = rf"(?:^|(?<=\.) )((?:{name})(?:, (?:{name}))*): "
    for block in re.split(r"\n\s*\n", docstring or ""):
        if re.match(r"\s*>>>| {4}", block):
            yield f"<pre>{html.escape(textwrap.dedent(block), quote=False)}</pre>\n"
            continue
        about = re.split(start, block, flags=re.M)
        if about[0].strip():
            yield f"<p>{marked(about[0])}</p>\n"
        if about[1:]:
            rows = (f"<dt><code>{names}</code></dt><dd>{marked(text)}</dd>\n" for names, text in zip(about[1::2], about[2::2]))
            yield f"<dl>\n{''.join(rows)}</dl>\n"


def arguments_of(function):
    arguments = function.args
    every = [*arguments.posonlyargs, *arguments.args, arguments.vararg, *arguments.kwonlyargs, arguments.kwarg]
    return [argument for argument in every if argument]


def marked(text):
    return re.sub(r"`+([^`]+)`+", r"<code>\1</code>", html.escape(text.strip(), quote=False))


class PythonPage:
    def __init__(self, package):
        self.package = package
        self.module = ast.parse(read(os.path.join(package, "__init__.py")))
        self.origin = {}
        for node in self.module.body:
            if isinstance(node, ast.ImportFrom) and node.level == 1:
                self.origin.update({alias.asname or alias.name: (node.module, alias.name) for alias in node.names})

    def public(self):
        """The names of __all__."""
        for node in self.module.body:
            if isinstance(node, ast.Assign) and getattr(node.targets[0], "id", "") == "__all__":
                return sorted(ast.literal_eval(node.value), key=str.lower)
        raise SystemExit("the package has no __all__")

    def definition(self, name):
        """The function or class of that name; None if it is neither."""
        if name not in self.origin:
            return None
        module, original = self.origin[name]
        tree = ast.parse(read(os.path.join(self.package, module + ".py")))
        found = [node for node in ast.walk(tree) if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name == original]
        return found[-1] if found else None

    def signature(self, name, function, is_method):
        arguments = function.args
        if is_method and arguments.args:
            arguments.args = arguments.args[1:]
        result = f" -> {ast.unparse(function.returns)}" if function.returns and function.name != "__init__" else ""
        line = f"{name}({ast.unparse(arguments)}){result}"
        if len(line) > 90:
            line = f"{name}(\n    " + ",\n    ".join(written(arguments)) + f"){result}"
        return f"<pre>{html.escape(line, quote=False)}</pre>\n"

    def function(self, name, function, heading, is_method=False):
        decorators = {ast.unparse(decorator) for decorator in function.decorator_list}
        yield f'<h{heading} id="{name}"><code>{name}</code></h{heading}>\n'
        if "property" not in decorators:
            yield self.signature(name.split(".")[-1], function, is_method and "staticmethod" not in decorators)
        yield from rendered(ast.get_docstring(function), function)

    def a_class(self, name, node):
        yield f'<h3 id="{name}"><code>{name}</code></h3>\n'
        bases = [ast.unparse(base) for base in node.bases]
        methods = [item for item in node.body if isinstance(item, ast.FunctionDef)]
        start = next((method for method in methods if method.name == "__init__"), None)
        if start:
            yield self.signature(name, start, True)
        elif bases:
            yield f"<pre>class {name}({', '.join(bases)})</pre>\n"
        yield from rendered(ast.get_docstring(node), start)
        for method in methods:
            if not method.name.startswith("_") and ast.get_docstring(method):
                yield from self.function(f"{name}.{method.name}", method, 4, True)

    def body(self):
        """The page, and what stands beside it."""
        kinds = {"Functions": [], "Classes": [], "Errors": [], "Constants": []}
        for name in self.public():
            node = self.definition(name)
            kind = "Constants" if node is None else "Functions" if isinstance(node, ast.FunctionDef) else \
                "Errors" if re.search(r"(Error|Warning)$", name) else "Classes"
            kinds[kind].append((name, node))
        parts, contents = ["<h1>tribox for Python</h1>\n", *rendered(ast.get_docstring(self.module))], []
        for kind, entries in kinds.items():
            contents.append((kind.lower(), kind, False))
            parts.append(f'<h2 id="{kind.lower()}">{kind}</h2>\n')
            if kind == "Constants":
                names = ", ".join(f'<code id="{name}">{name}</code>' for name, _ in entries)
                parts.append(f"<p>{names}</p>\n")
                continue
            for name, node in entries:
                contents.append((name, name, True))
                parts.extend(self.function(name, node, 3) if kind == "Functions" else self.a_class(name, node))
        return "".join(parts), contents


def written(arguments):
    """Each argument with its default, in Python."""
    def alone(plain=(), vararg=None, kwarg=None, default=None):
        return ast.unparse(ast.arguments([], list(plain), vararg, [], [], kwarg, [default] if default else []))

    plain = [*arguments.posonlyargs, *arguments.args]
    for argument, default in zip(plain, [None] * (len(plain) - len(arguments.defaults)) + arguments.defaults):
        yield alone([argument], default=default)
    if arguments.vararg:
        yield alone(vararg=arguments.vararg)
    elif arguments.kwonlyargs:
        yield "*"
    for argument, default in zip(arguments.kwonlyargs, arguments.kw_defaults):
        yield alone([argument], default=default)
    if arguments.kwarg:
        yield alone(kwarg=arguments.kwarg)
