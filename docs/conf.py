"""The documents as a site, `cmake --build build/release --target site`. Pages stay where they are in the tree.

Sphinx and MyST make it, because their search works from a folder, without a server."""

import os
import re

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
with open(os.path.join(root, "CMakeLists.txt"), encoding="utf-8") as lists:
    version = release = re.search(r"project\(crossgrain VERSION (\S+)", lists.read())[1]
project = "crossgrain"
author = "the crossgrain developers"
project_copyright = f"{author}, GPL-3.0-or-later"

extensions = ["myst_parser"]
myst_heading_anchors = 4  # the anchors that a repository's pages have
root_doc = "docs/README"
exclude_patterns = ["build*", "changes/[a-z]*", "**/node_modules", "out"]
html_theme = "furo"
html_title = f"{project} {version}"
html_show_sourcelink = html_copy_source = False


def sidebar(index):
    """Returns the lists of pages that Sphinx wants: the kinds and the tables of docs/README.md."""
    lists = ""
    for kind, table in re.findall(r"^\*\*(\w[\w ]*)\*\*(.*?)(?=^\*\*|\Z)", index, re.M | re.S):
        pages = [os.path.normpath(os.path.join("docs", page)) for page in re.findall(r"\]\(([^)#]+)\.md\)", table)]
        lists += "\n```{toctree}\n:hidden:\n:caption: %s\n\n/%s\n```\n" % (kind, "\n/".join(pages))
    return lists


def read_page(app, name, source):
    """Links a folder by its README; adds the sidebar to the index, and lets other pages stand outside it."""
    folder = os.path.dirname(os.path.join(root, name))

    def to_page(link):
        target = os.path.join(folder, link[2])
        if not os.path.isdir(target):
            return link[0]
        has_page = os.path.exists(os.path.join(target, "README.md"))
        return f"[{link[1]}]({link[2].rstrip('/')}/README.md)" if has_page else link[1]

    text = re.sub(r"\[([^\]]+)\]\(([^)#:]+)\)", to_page, source[0])
    source[0] = text + sidebar(text) if name == root_doc else "---\norphan: true\n---\n" + text


def write_entry(app, error):
    """The folder opens at the index of the documents."""
    with open(os.path.join(app.outdir, "index.html"), "w", encoding="utf-8") as entry:
        entry.write(f'<!doctype html><meta http-equiv="refresh" content="0; url={root_doc}.html">\n')


def setup(app):
    app.connect("source-read", read_page)
    app.connect("build-finished", write_entry)
