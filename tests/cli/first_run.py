"""tools/run in a tree without a program: first_run.py PROGRAM SOURCE_FOLDER

The build is a stand-in that makes a script which calls PROGRAM. A signal to tools/run reaches the scene that runs: the
results up to there are kept, and the exit code is that of an interrupted run.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

program, source = map(pathlib.Path, sys.argv[1:])


def interrupted_by(sent, folder):
    (folder / "tools").mkdir()
    shutil.copy(source / "tools/run", folder / "tools/run")
    build = folder / "tools/build"
    build.write_text(f"""#!/bin/sh
mkdir -p '{folder}/build/bin' && cd '{folder}/build/bin'
printf '#!/bin/sh\necho $$ >"{folder}/pid"; exec "{program}" "$@"\n' >trammel && chmod +x trammel
""")
    build.chmod(0o755)
    scene = (source / "scenes/beam_impact.json").read_text()
    assert '"until": 2.0' in scene
    (folder / "long.json").write_text(scene.replace('"until": 2.0', '"until": 1e6'))

    environment = {name: value for name, value in os.environ.items() if name != "TRAMMEL_BUILD_DIR"}
    run = subprocess.Popen([folder / "tools/run", folder / "long.json", "--out", folder / "out", "--quiet"],
                           stderr=subprocess.PIPE, text=True, start_new_session=True, env=environment,
                           preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))  # a shell's & ignores it
    try:
        late = time.monotonic() + 60
        while not (folder / "out/series.csv").exists() and run.poll() is None and time.monotonic() < late:
            time.sleep(0.02)
        run.send_signal(sent)
        error = run.communicate(timeout=60)[1]
    finally:
        if run.poll() is None:
            run.kill()
            os.kill(int((folder / "pid").read_text()), signal.SIGKILL)
    assert run.returncode == 130, f"{sent.name}: exit code {run.returncode}\n{error}"
    status = json.loads((folder / "out/result.json").read_text())["status"]
    assert status == "interrupted", status


for sent in (signal.SIGTERM, signal.SIGINT):
    with tempfile.TemporaryDirectory() as folder:
        interrupted_by(sent, pathlib.Path(folder))
