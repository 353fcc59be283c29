"""Mathematics as MathML, which browsers draw themselves: no script, and nothing from another host."""

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.util import logging

logger = logging.getLogger(__name__)
# spellings of TeX that the converter lacks
SPELLINGS = {r"\Big/": "/", r"\lbrace": r"\{", r"\rbrace": r"\}"}


def converted(node, as_block):
    text = node.astext()
    for theirs, ours in SPELLINGS.items():
        text = text.replace(theirs, ours)
    try:
        return latex2mathml.tex2mathml(text, as_block=as_block)
    except Exception as error:
        logger.warning("mathematics: %s in %s", error, text, location=node)
        return text


def inline(self, node):
    self.body.append(converted(node, as_block=False))
    raise nodes.SkipNode


def block(self, node):
    self.body.append(f'<div class="math">{converted(node, as_block=True)}</div>\n')
    raise nodes.SkipNode


def setup(app):
    app.add_html_math_renderer("mathml", (inline, None), (block, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}
