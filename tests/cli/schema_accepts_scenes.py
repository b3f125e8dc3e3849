"""Every scene of the repository is valid by the JSON Schema that `trammel schema` prints, by a validator that is not ours.

    schema_accepts_scenes.py PROGRAM SCENES_FOLDER
"""
import json
import pathlib
import re
import subprocess
import sys

import jsonschema

COMMENT_OR_STRING = re.compile(r'"(?:\\.|[^"\\])*"|//[^\n]*|/\*.*?\*/', re.S)


def load(path):
    return json.loads(COMMENT_OR_STRING.sub(lambda m: m[0] if m[0].startswith('"') else " ", path.read_text()))


def main(program, folder):
    schema = json.loads(subprocess.run([program, "schema"], check=True, capture_output=True, text=True).stdout)
    jsonschema.Draft202012Validator.check_schema(schema)
    validator = jsonschema.Draft202012Validator(schema)
    scenes = sorted(f for f in pathlib.Path(folder).rglob("*.json") if f.parent.name != "studies")
    refused = 0
    for scene in scenes:
        for error in validator.iter_errors(load(scene)):
            print(f"{scene}: {'.'.join(map(str, error.absolute_path))}: {error.message}")
            refused += 1
    mistaken = {"trammel": 1, "bodies": {"b": {"type": "rigid_body", "mas": 1}}, "simulate": {"until": 1}}
    if validator.is_valid(mistaken):
        print("the schema accepts a misspelt key")
        refused += 1
    print(f"{len(scenes)} scenes, {refused} refused")
    return 1 if refused or not scenes else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
