"""The reference of the Python package, from its sources alone: nothing has to be built or imported.

Signatures are those of the stubs and of the package's modules, texts those of the docstrings: of the extension they
are the comments of its Rust.
"""

import ast
import re
from pathlib import Path

from sphinx.ext.napoleon import Config, NumpyDocstring

PACKAGE = Path(__file__).resolve().parents[2] / "python"
PAGE, PLACE = "python-api", "<!-- reference -->"


def rust_docs():
    """What stands above each class, function and method of the extension, by its name in Python."""
    found = {}
    for path in sorted((PACKAGE / "src").glob("*.rs")):
        owner, doc = None, []
        for line in path.read_text(encoding="utf-8").split("\n"):
            text = line.strip()
            if text.startswith("///"):
                doc.append(text[3:].removeprefix(" "))
                continue
            if text.startswith("#["):
                continue
            if match := re.match(r"impl (\w+) \{", line):
                owner = match[1]
            elif line == "}":
                owner = None
            elif doc and (match := re.match(r"(?:pub(?:\(crate\))? )?(fn|struct) (\w+)", text)):
                name = f"{owner}.{match[2]}" if owner and match[1] == "fn" else match[2]
                found.setdefault(name, "\n".join(doc))
            doc = []
    return found


def signature(function, is_method):
    arguments = function.args
    if is_method and arguments.args:
        arguments.args = arguments.args[1:]
    for argument in [*arguments.posonlyargs, *arguments.args, *arguments.kwonlyargs, arguments.vararg, arguments.kwarg]:
        if argument:
            argument.annotation = None
    return ast.unparse(arguments)


def decorators(function):
    return {ast.unparse(decorator) for decorator in function.decorator_list}


def described(directive, name, doc, indent=""):
    """One entry, as reStructuredText."""
    text = str(NumpyDocstring(doc or "", Config(napoleon_use_rtype=False)))
    lines = [f".. py:{directive}:: {name}", *(["   :no-index:"] if directive == "property" else []), ""]
    lines += ["   " + line for line in text.split("\n")] + [""]
    return [indent + line if line.strip() else "" for line in lines]


def entries(node, docs):
    """The entry of a class or function, with those of its public members."""
    own = lambda name, of: ast.get_docstring(of) or docs.get(name, "")
    if isinstance(node, ast.FunctionDef):
        return described("function", f"{node.name}({signature(node, False)})", own(node.name, node))
    initialiser = next((of for of in node.body if getattr(of, "name", "") in ("__init__", "__new__")), None)
    head = f"{node.name}({signature(initialiser, True)})" if initialiser else node.name
    lines, seen = described("class", head, own(node.name, node)), set()
    for member in node.body:
        if not isinstance(member, ast.FunctionDef) or member.name.startswith("_") or member.name in seen:
            continue
        seen.add(member.name)
        doc, marks = own(f"{node.name}.{member.name}", member), decorators(member)
        if "property" in marks or "cached_property" in marks:
            # those without a text of their own are among the attributes of the class
            lines += described("property", member.name, doc, "   ") if doc else []
        else:
            kind = "classmethod" if "classmethod" in marks else "method"
            lines += described(kind, f"{member.name}({signature(member, 'staticmethod' not in marks)})", doc, "   ")
    return lines


def reference():
    """Every public name of the package in the order of its `__all__`."""
    tree = ast.parse((PACKAGE / "uplift_urs/__init__.py").read_text(encoding="utf-8"))
    public = next(
        ast.literal_eval(of.value)
        for of in tree.body
        if isinstance(of, ast.Assign) and ast.unparse(of.targets[0]) == "__all__"
    )
    nodes = {}
    for path in [*sorted((PACKAGE / "uplift_urs").glob("_*.py")), PACKAGE / "uplift_urs/_native.pyi"]:
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                nodes.setdefault(node.name, node) if path.suffix == ".py" else nodes.update({node.name: node})
    docs, lines = rust_docs(), [".. py:module:: uplift_urs", ""]
    for name in public:
        if name in nodes:
            lines += entries(nodes[name], docs)
    return "\n".join(lines)


def fill(_app, name, source):
    if name == PAGE:
        source[0] = source[0].replace(PLACE, "```{eval-rst}\n" + reference() + "\n```")


def setup(app):
    app.connect("source-read", fill)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
