"""Every case of tests/cli/cases that is about form is refused by the JSON Schema that `trammel schema` prints.

    schema_refuses_cases.py PROGRAM CASES_FOLDER

Form is what a file shows without its meaning: keys, types of values, ranges, names of components. The message that the
program gives shows whether a case is about form. As in the program, includes are merged and --set is applied first.
"""
import json
import pathlib
import re
import subprocess
import sys

import jsonschema

from schema_accepts_scenes import load

FORM = re.compile(
    r'unknown key|has no parameter "|type: no (integrator|body|joint|force|contact|friction|correction) "|"type" is missing|'
    r'"trammel": 1 is missing|of the scene format, expected|'
    r'found (-?[0-9.e-]+|null|an? \w+|the text "\w*"|"\w*"), expected (a number(?! or)|an object|an array|a text|a step > 0|"planar")')


def merged(base, over):
    """JSON merge patch; an object with another "type" replaces the whole one."""
    if not (isinstance(base, dict) and isinstance(over, dict)):
        return over
    if "type" in over and over["type"] != base.get("type"):
        return over
    result = dict(base)
    for key, value in over.items():
        if value is None and key in base:
            result.pop(key, None)
        else:
            result[key] = merged(base.get(key), value)
    return result


def with_includes(path):
    scene = load(path)
    if not isinstance(scene, dict) or "include" not in scene:
        return scene
    included = scene.pop("include")
    base = {}
    for name in [included] if isinstance(included, str) else included:
        base = merged(base, with_includes(path.parent / name))
    return merged(base, scene)


def set_value(scene, path, text):
    *way, last = path.split(".")
    for key in way:
        if not isinstance(scene.get(key), dict):
            scene[key] = {}
        scene = scene[key]
    try:
        scene[last] = json.loads(text)
    except json.JSONDecodeError:
        scene[last] = text


def resolved(path, head):
    scene = with_includes(path)
    words = head[0].split()
    for option, value in zip(words, words[1:]):
        if option == "--set":
            set_value(scene, *value.split("=", 1))
    return scene


def main(program, folder):
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
    validator = jsonschema.Draft202012Validator(schema)
    of_form, accepted = 0, 0
    for case in sorted(pathlib.Path(folder).glob("*.json")):
        head = [line for line in case.read_text().splitlines() if line.startswith("// ")]
        if not any(FORM.search(line) for line in head):
            continue
        of_form += 1
        if validator.is_valid(resolved(case, head)):
            print(f"{case.name}: the schema accepts what the program refuses: {head[2]}")
            accepted += 1
    print(f"{of_form} cases of form, {accepted} accepted")
    return 1 if accepted or of_form < 25 else 0  # there are more than 25: FORM must not miss them


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
