# Sphinx's settings for docs/build, which makes the site from Markdown all over the repository: the root of the sources is
# that of the repository, so that each link between files is the same here, in an editor and on GitHub.
import glob
import os
import re

project = "epicyclic"
author = "the epicyclic developers"
copyright = author
extensions = ["myst_parser", "sphinx.ext.mathjax"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4

root_doc = "docs/README"
include_patterns = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/**.md", "lib/EQUATIONS.md", "validation/**.md"]
exclude_patterns = ["build", "out", ".git", "tests", "app"]

html_theme = "furo"
html_title = "epicyclic"
html_show_sourcelink = False
html_copy_source = False
# Debian's MathJax is version 2, which MyST does not know how to point at the formulas.
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML"
myst_update_mathjax = False
mathjax2_config = {"tex2jax": {"processClass": "tex2jax_process|mathjax_process|math|output_area"}}

# Validation pages are records, each with a heading level of its own.
suppress_warnings = ["myst.header"]

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
link = re.compile(r"(?<!!)\[((?:[^\]\[]|\[[^\]]*\])*)\]\(([^)\s]+)\)")


def pages():
    """The other pages, in the order of the index and behind them those of the rest of the repository."""
    with open(os.path.join(root, "docs", "README.md"), encoding="utf-8") as index:
        named = [target.partition("#")[0] for _, target in link.findall(index.read())]
    of_docs = [name[:-3] for name in dict.fromkeys(named) if name.endswith(".md") and not name.startswith("..")]
    of_docs = [name for name in of_docs if os.path.exists(os.path.join(root, "docs", name + ".md"))]
    found = glob.glob(os.path.join(root, "validation", "**", "*.md"), recursive=True)
    validation = sorted(("/" + os.path.relpath(path, root)[:-3] for path in found), key=lambda name: (name.count("/"), name))
    groups = [("Tutorials", "tutorials/"), ("How-to", "howto/"), ("Reference", "reference/"), ("Theory", "theory/")]
    trees = [(title, [name for name in of_docs if name.startswith(folder)]) for title, folder in groups]
    trees.append(("More", ["glossary", "/README", "/CONTRIBUTING", "/CHANGELOG", "/lib/EQUATIONS"]))
    trees.append(("Validation", validation))
    return trees


def to_site(app, docname, source):
    """What GitHub does by itself: a link to a folder leads to its README.md, and one to a folder without is text. The
    index gets the contents of the site. The history keeps links to pages that are gone: they are text."""

    def lead(match):
        text, target = match.group(1), match.group(2)
        if re.match(r"[a-z]+:|#", target):
            return match.group(0)
        path, mark, anchor = target.partition("#")
        at = os.path.normpath(os.path.join(root, os.path.dirname(docname), path))
        if os.path.isdir(at):
            if os.path.exists(os.path.join(at, "README.md")):
                return "[%s](%s%s%s)" % (text, os.path.join(path, "README.md"), mark, anchor)
            return text
        if docname == "CHANGELOG" and not os.path.exists(at):
            return text
        return match.group(0)

    source[0] = link.sub(lead, source[0])
    if docname == root_doc:
        for title, names in pages():
            if names:
                listed = "\n".join(names)
                source[0] += "\n```{toctree}\n:hidden:\n:caption: %s\n\n%s\n```\n" % (title, listed)


def setup(app):
    app.connect("source-read", to_site)
