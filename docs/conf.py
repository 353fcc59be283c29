"""The book: `make book` builds it into target/book without network."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent / "_ext"))

project = "uplift"
author = "the authors of uplift"
copyright = "the authors of uplift, MIT or Apache-2.0"

extensions = ["myst_parser", "sphinx.ext.napoleon", "mathml", "python_api"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["_ext", "_static", "notebooks"]

myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
html_math_renderer = "mathml"
default_role = "code"
highlight_language = "none"
napoleon_use_rtype = False

html_theme = "furo"
html_title = "uplift"
html_theme_options = {"navigation_with_keys": True}
html_static_path = ["_static"]
html_css_files = ["book.css"]
html_copy_source = False
html_show_sourcelink = False
html_show_sphinx = False
