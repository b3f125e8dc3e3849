#!/usr/bin/env python3
"""Runs the tutorial of plugins/README.md in an empty folder, as its reader does: tutorial.py PROGRAM SOURCE BUILD FLAGS.

What follows "$ " is a command, the lines below it are what it prints; "..." stands for any lines. Numbers are compared to two
digits: the last ones depend on the compiler and the processor."""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

PROGRAM, SOURCE, BUILD, FLAGS = Path(sys.argv[1]).resolve(), Path(sys.argv[2]), sys.argv[3], sys.argv[4]


def blocks(text):
    """(language, content) of the fenced blocks, in their order."""
    return re.findall(r"^```(\w+)\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def commands(block):
    """(command, lines that it prints)."""
    parts = re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]
    return [(part.split("\n")[0], part.rstrip("\n").split("\n")[1:]) for part in parts]


def rounded(line):
    return re.sub(r"\d+(\.\d+)?(e[+-]?\d+)?", lambda number: f"{float(number.group()):.1e}", line)


def prints(expected, printed):
    """True if the printed lines are the expected ones, "..." standing for any number of lines."""
    pattern = "".join(".*" if line == "..." else re.escape(rounded(line)) + "\n" for line in expected)
    return re.fullmatch(pattern, rounded(printed.rstrip("\n") + "\n"), re.DOTALL) is not None


def main():
    text = (SOURCE / "plugins/README.md").read_text()
    folder = Path(tempfile.mkdtemp(prefix="tutorial_"))
    environment = os.environ | {"PATH": f"{PROGRAM.parent}:{os.environ['PATH']}", "Trammel_DIR": BUILD, "CXXFLAGS": FLAGS}
    environment.pop("TRAMMEL_PLUGIN_PATH", None)
    for language, content in blocks(text):
        if language == "cpp":
            (folder / "sdirk2/sdirk2.cpp").write_text(content)
        for command, expected in commands(content) if language == "console" else []:
            done = subprocess.run(["bash", "-c", command.replace("/usr/share/trammel/scenes", str(SOURCE / "scenes"))],
                                  cwd=folder, env=environment, capture_output=True, text=True)
            if command.startswith("cd "):
                folder = folder / command.split()[1]
            if not prints(expected, done.stdout):
                print(f"$ {command}\nprints\n{done.stdout}{done.stderr}\nand not\n" + "\n".join(expected))
                return 1
    return 0


sys.exit(main())
