"""Configuration of Sphinx: Markdown pages, the furo theme, and the public names taken from the docstrings."""

import importlib.metadata

project = "embedding"
author = copyright = "The embedding developers"
release = version = importlib.metadata.version("embedding")

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx.ext.mathjax",
    "sphinx-mathjax-offline",
]
myst_enable_extensions = ["amsmath", "dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["_build"]
suppress_warnings = ["config.cache"]

html_theme = "furo"
html_title = f"embedding {release}"

autodoc_member_order = "bysource"
autodoc_typehints = "description"
