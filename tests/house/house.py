#!/usr/bin/env python3
"""Whether the tree is as its READMEs and framework/CMakeLists.txt say: house.py CLAIM SOURCE [PROGRAM]; exit code 1 if not."""

import re
import subprocess
import sys
from pathlib import Path

CODE = (".cpp", ".hpp")


def code_files(folder):
    return sorted(f for f in folder.rglob("*") if f.suffix in CODE)


def rooms(source):
    """The rooms of libtrammel and libtrammel_analyses, lowest first, from framework/CMakeLists.txt."""
    text = (source / "framework/CMakeLists.txt").read_text()
    return re.search(r"set\(TRAMMEL_ROOMS([^)]*)\)", text).group(1).split()


def folders_with_code(source):
    for top in ("framework", "bodies", "plugins"):
        for folder in sorted((source / top).rglob("*")):
            if folder.is_dir() and any(f.suffix in CODE for f in folder.iterdir()):
                yield folder


def rooms_include_only_lower_rooms(source, _):
    order = rooms(source)
    for room in order:
        for file in sorted((source / "framework" / room).glob("*.[ch]pp")):
            for included in re.findall(r'#include "([^"]+)"', file.read_text()):
                other = str(Path(included).parent)
                if other in order and order.index(other) > order.index(room):
                    yield f"{file.relative_to(source)} includes {included}, which is in a higher room"
                elif other not in order and included != "trammel_commit.hpp":
                    yield f"{file.relative_to(source)} includes {included}, which is in no room"


def every_folder_is_a_room(source, _):
    order = set(rooms(source)) | {"testing", "testing/problems", "testing/kit", "testing/kit/components",
                                 "testing/kit/integrators", "stability"}
    for folder in folders_with_code(source):
        name = str(folder.relative_to(source / "framework")) if "framework" in folder.parts else ""
        if name and not name.startswith("include") and name not in order:
            yield f"framework/{name} is not in TRAMMEL_ROOMS"


def rooms_have_at_most_thirty_sources(source, _):
    # About 25 is what a reader takes in at a glance; the bound leaves a room time to be divided.
    for folder in folders_with_code(source):
        count = sum(f.suffix in CODE for f in folder.iterdir())
        if count > 30 and folder.name != "trammel":
            yield f"{folder.relative_to(source)} holds {count} sources: divide it by concept"


def every_room_has_a_readme_of_one_screen(source, _):
    for folder in folders_with_code(source):
        if "problems" in folder.parts or folder.name in ("methods", "testing") and "include" in folder.parts:
            continue
        readme = folder / "README.md"
        if not readme.exists():
            yield f"{folder.relative_to(source)} has no README.md"
        elif len(readme.read_text().splitlines()) > 75:
            yield f"{readme.relative_to(source)} is longer than a screen (75 lines)"


def readmes_name_every_source(source, _):
    # "spring_impact*" in a README names all sources whose names begin like that.
    for folder in folders_with_code(source):
        readme = folder / "README.md"
        if folder.parts[-2:] == ("testing", "problems") or not readme.exists():
            continue
        text = readme.read_text()
        prefixes = tuple(re.findall(r"`(\w+)\*`", text))
        for name in sorted({f.stem for f in folder.iterdir() if f.suffix in CODE}):
            if not re.search(rf"\b{name}\b", text) and not (prefixes and name.startswith(prefixes)):
                yield f"{readme.relative_to(source)} does not name {name}"


def components(program):
    """{kind: [name, ...]} as `trammel list` prints them."""
    kinds, kind = {}, None
    for line in subprocess.run([program, "list"], capture_output=True, text=True, check=True).stdout.splitlines():
        if line and not line.startswith(" "):
            kind = kinds.setdefault(line.strip(), [])
        elif line.startswith("  ") and line[2] != " ":
            kind.append(line.split()[0])
    return {k: v for k, v in kinds.items() if k in
            ("integrator", "body", "joint", "force", "contact", "friction", "correction")}


def in_backticks(file):
    return set(re.findall(r"`([a-z_0-9]+)`", file.read_text()))


def readmes_name_every_component(source, program):
    overview = in_backticks(source / "plugins/README.md")
    folders = {"integrator": "integrators", "joint": "joints", "force": "forces", "contact": "contacts",
               "friction": "friction", "correction": "corrections"}
    for kind, names in components(program).items():
        files = {"bodies/README.md": in_backticks(source / "bodies/README.md")} if kind == "body" else \
            {"plugins/README.md": overview,
             f"plugins/{folders[kind]}/README.md": in_backticks(source / f"plugins/{folders[kind]}/README.md")}
        for file, named in files.items():
            for name in names:
                if name not in named:
                    yield f"{file} does not name the {kind} `{name}`"


def tables_of_folders_name_folders_that_are_there(source, _):
    for readme in sorted(source.rglob("README.md")):
        if "build" in readme.relative_to(source).parts[0] or ".git" in readme.parts:
            continue
        for row in readme.read_text().splitlines():
            if not row.startswith("|"):
                continue
            for name in re.findall(r"`([a-z_0-9/]+/)`", row.split("|")[1]):
                if not (readme.parent / name).is_dir():
                    yield f"{readme.relative_to(source)} names the folder {name}, which is not there"


def the_readme_names_every_command(source, program):
    readme = (source / "README.md").read_text()
    for command in re.findall(r"^  trammel (\w+)", subprocess.run(
            [program, "--help"], capture_output=True, text=True, check=True).stdout, re.M):
        if f"trammel {command}" not in readme:
            yield f"README.md does not name the command 'trammel {command}'"


def lines_fit_the_formatter(source, _):
    limit = 120  # ColumnLimit of .clang-format; texts, which must stay whole, are the exception
    for top in ("framework", "bodies", "plugins", "tools", "tests"):
        for file in code_files(source / top):
            raw = False  # inside R"page(...)page"
            for number, line in enumerate(file.read_text().splitlines(), 1):
                raw = bool(re.search(r'R"\w*\(', line)) or raw
                if len(line) > limit and '"' not in line and not raw:
                    yield f"{file.relative_to(source)}:{number} is longer than {limit} columns"
                raw = raw and not re.search(r'\)\w*"', line)


def main():
    claim, source, program = sys.argv[1], Path(sys.argv[2]), sys.argv[3] if len(sys.argv) > 3 else ""
    faults = list(globals()[claim](source, program))
    print("\n".join(faults) or "holds")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
