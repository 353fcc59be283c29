"""Mathematics as MathML, which browsers draw themselves, with a font that is part of the book: no script, and nothing
from another host.
"""

import re
import shutil
from importlib.resources import files
from pathlib import Path
from xml.etree import ElementTree

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.util import logging

logger = logging.getLogger(__name__)
# spellings of TeX that the converter lacks
SPELLINGS = {r"\lbrace": r"\{", r"\rbrace": r"\}", r"\lvert": r"\left|", r"\rvert": r"\right|"}
FUNCTIONS = {"sin", "cos", "tan", "atan", "ln", "exp", "max", "min", "sgn", "median"}
ROWS = {"math", "mrow", "mstyle", "mtd", "msqrt"}
MATHML = "http://www.w3.org/1998/Math/MathML"


def tag(element):
    return element.tag.rpartition("}")[2]


def is_function(element):
    """A name like sin, or such a name with an exponent."""
    while tag(element) in ("msup", "msub", "munder") and len(element):
        element = element[0]
    return tag(element) == "mi" and (element.text or "").strip() in FUNCTIONS


def spaced(text):
    """With the thin spaces of TeX around the names of functions."""
    tree = ElementTree.fromstring(re.sub(r"<mo>&ApplyFunction;</mo>", "", text))
    for row in [tree, *tree.iter()]:
        if tag(row) not in ROWS:
            continue
        children = list(row)
        for child in children:
            if not is_function(child):
                continue
            at = list(row).index(child)
            after = row[at + 1] if at + 1 < len(row) else None
            if after is not None and tag(after) not in ("mo", "mspace"):
                row.insert(at + 1, ElementTree.Element(f"{{{MATHML}}}mspace", width="0.17em"))
            if at > 0 and tag(row[at - 1]) not in ("mo", "mspace"):
                row.insert(at, ElementTree.Element(f"{{{MATHML}}}mspace", width="0.17em"))
    return ElementTree.tostring(tree, encoding="unicode")


def converted(node, as_block):
    text = node.astext()
    for theirs, ours in SPELLINGS.items():
        text = text.replace(theirs, ours)
    try:
        return spaced(latex2mathml.tex2mathml(text, as_block=as_block))
    except Exception as error:
        logger.warning("mathematics: %s in %s", error, text, location=node)
        return text


def inline(self, node):
    self.body.append(converted(node, as_block=False))
    raise nodes.SkipNode


def block(self, node):
    self.body.append(f'<div class="formula">{converted(node, as_block=True)}</div>\n')
    raise nodes.SkipNode


ElementTree.register_namespace("", MATHML)


def add_font(app):
    """STIX Two Math (SIL Open Font License), which the package ziamath has."""
    font = files("ziamath") / "fonts/STIXTwoMath-Regular.ttf"
    static = Path(app.outdir) / "_static"
    static.mkdir(parents=True, exist_ok=True)
    shutil.copyfile(str(font), static / "STIXTwoMath-Regular.ttf")


def setup(app):
    app.connect("builder-inited", add_font)
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
