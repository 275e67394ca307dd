#!/usr/bin/env python3
"""Writes the table of docs/commands.md from the program's own help: docs/commands.py PROGRAM

A row is a command with its arguments and required options, what it does, and its other options but for those that the
page lists as common.
"""

import os
import pathlib
import re
import subprocess
import sys

PAGE = pathlib.Path(__file__).with_name("commands.md")
HEAD = "| command | does | options of its own |\n|---|---|---|\n"
COMMON = {"--help", "--engine", "--set", "--fresh", "--json", "--verbose", "--quiet", "--dry-run", "--resume", "--jobs"}


def help_of(program, *command):
    wide = os.environ | {"COLUMNS": "1000"}
    return subprocess.run([program, *command, "--help"], capture_output=True, encoding="utf-8", check=True, env=wide).stdout


def commands_of(program):
    listed = help_of(program).partition("Exit status:\n")[0]
    return re.findall(r"(?m)^  ([a-z]\S*) +\S", listed)


def row_of(program, command):
    text = help_of(program, command)
    usage = re.search(r"(?m)^Usage: crossgrain (.*)$", text).group(1).replace(" [OPTIONS]", "")
    options = re.findall(r"(?m)^  (?:-\w,)?(--[\w-]+|-\w(?= ))(?: ([^\s'=]+\S*))?(?:(?: \.\.\.)? (REQUIRED))?", text)
    usage += "".join(f" {name} {value}" for name, value, required in options if required)
    others = ", ".join(f"`{name}`" for name, value, required in options if not required and name not in COMMON)
    cells = [f"`{usage}`", text.splitlines()[0], others]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n"


def table_of(program):
    return HEAD + "".join(row_of(program, command) for command in commands_of(program))


def written(page, table):
    return re.sub(r"(?s)\| command \|.*?\n\n", lambda _: table + "\n", page, count=1)


if __name__ == "__main__":
    PAGE.write_text(written(PAGE.read_text(encoding="utf-8"), table_of(sys.argv[1])), encoding="utf-8")
