"""Starting the program `clathra`."""
import contextlib
import json
import math
import numbers
import os
import shutil
import signal
import subprocess
import sys
import tempfile
from typing import Any, Callable, Union

import numpy as np

from .results import Path, Run, Study, open_run, open_study

Scene = Union[dict, Path]  # sections and keys, or the name of a file
Progress = Union[bool, Callable[[str], Any]]


class ClathraError(RuntimeError):
    """The program ended with an error: `code` is its exit code, the text what it said."""

    def __init__(self, code: int, text: str) -> None:
        super().__init__(f"clathra ended with exit code {code}:\n{text.strip()}")
        self.code = code


def program() -> str:
    """The path of the program: $CLATHRA, else the one in PATH, else that of the build folder beside this package's sources."""
    built = os.path.join(os.path.dirname(__file__), "..", "..", "..", "build", "release", "drivers", "clathra")
    for candidate in (os.environ.get("CLATHRA"), shutil.which("clathra"), built):
        if candidate and os.access(candidate, os.X_OK):
            return candidate
    raise FileNotFoundError("the program clathra is neither in PATH nor named by the variable CLATHRA")


def _toml_value(value):
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        if not math.isfinite(value):
            raise ValueError(f"a scene's value is a finite number, not {value}")
        return repr(float(value))
    if isinstance(value, np.ndarray):
        return _toml_value(value.tolist())  # an array without axes is a number
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(_toml_value(item) for item in value) + "]"
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value))
    raise TypeError(f"a scene's value is text, a number, a truth value or a list, not {type(value).__name__}")


def _toml(sections):
    """A scene or study as TOML text; sections may hold sections (groups of a study)."""
    text = "".join(f"{json.dumps(key)} = {_toml_value(value)}\n" for key, value in sections.items() if not isinstance(value, dict))

    def add(prefix, section):
        nonlocal text
        plain = {key: value for key, value in section.items() if not isinstance(value, dict) or {"from", "to", "count"} == set(value)}
        text += f"\n[{prefix}]\n"
        for key, value in plain.items():
            if isinstance(value, dict):
                text += f"{json.dumps(key)} = {{ " + ", ".join(f"{k} = {_toml_value(v)}" for k, v in value.items()) + " }\n"
            else:
                text += f"{json.dumps(key)} = {_toml_value(value)}\n"
        for key, value in section.items():
            if key not in plain:
                add(f"{prefix}.{json.dumps(key)}", value)

    for key, value in sections.items():
        if isinstance(value, dict):
            add(json.dumps(key), value)
    return text


def _show(line):
    print(line, file=sys.stderr, flush=True)


def _watch(arguments, progress):
    """Runs the program and hands each line that it says to `progress`. Ctrl-C stops it with a checkpoint before it is raised here."""
    # In a session of its own: a terminal's Ctrl-C comes to us alone, and once, which the program takes as a wish to stop.
    child = subprocess.Popen(arguments, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True)
    said = []
    try:
        with child.stdout:
            for line in child.stdout:
                said.append(line)
                if progress:
                    progress(line.rstrip("\n"))
        code = child.wait()
    except BaseException:
        child.send_signal(signal.SIGINT)
        child.wait()
        raise
    if code != 0:
        raise ClathraError(code, "".join(said))


@contextlib.contextmanager
def _file_of(what):
    """The name of a file, or of one in the current folder, so that paths in it hold, that a dictionary becomes for a while."""
    if not isinstance(what, dict):
        yield os.fspath(what)
        return
    text = _toml(what)
    descriptor, made = tempfile.mkstemp(suffix=".toml", prefix=".clathra-", dir=".")
    try:
        with os.fdopen(descriptor, "w", encoding="utf-8") as file:
            file.write(text)
        yield made
    finally:
        os.unlink(made)


def _options(options):
    """Options of the command line: max_walltime="1h" is --max-walltime 1h, resume=True is --resume, a list repeats an option."""
    arguments = []
    for name, value in options.items():
        option = "--" + name.replace("_", "-")
        if isinstance(value, np.ndarray):
            value = value.tolist()
        if isinstance(value, (bool, np.bool_)):
            arguments += [option] if value else []
        elif isinstance(value, (list, tuple)):
            for item in value:
                arguments += [option, str(item)]
        elif value is not None:
            arguments += [option, str(value)]
    return arguments


def _call(verb, what, output, progress, options):
    with _file_of(what) as file:
        _watch([program(), verb, file, "--output", os.fspath(output), *_options(options)], _show if progress is True else progress)


def check(scene: Scene, **options: Any) -> dict:
    """What `clathra check --json` says of a scene: its verdict ("valid", "guards ignored", "refused", "invalid"),
    problems (a file that is not there is one) or forecast (SI units) and warnings. Raises ClathraError where the program itself failed."""
    with _file_of(scene) as file:
        done = subprocess.run([program(), "check", file, "--json", *_options(options)], capture_output=True, text=True, errors="replace")
    said = json.loads(done.stdout or '{"verdict": "failed"}')
    if said["verdict"] == "failed":
        raise ClathraError(done.returncode, done.stderr)
    return said


def run(scene: Scene, output: Path, progress: Progress = True, **options: Any) -> Run:
    """Runs a scene and opens its results.

    scene: a dictionary of sections, {"specimen": {"particles": 2000}, "hydrate": {"saturation": "55 %"}}, values as in a scene
    file, NumPy's numbers and arrays among them; or the name of a scene file. output: folder of the results. progress: what the
    program says goes line by line to stderr (True), to a function of yours, or nowhere (False). options: those of `clathra run`,
    with _ for -: threads=2, resume=True, max_walltime="1h", set=["run.seed=2", "grains.friction=0.4"]. Raises ClathraError with
    what the program said. Ctrl-C stops the run with a checkpoint; resume=True goes on.
    """
    _call("run", scene, output, progress, options)
    return open_run(output)


def study(plan: Scene, output: Path, progress: Progress = True, **options: Any) -> Study:
    """Runs a study and opens its results.

    plan: a dictionary, {"scene": "quick.toml", "seeds": 5, "matrix": {"hydrate.saturation": ["26 %", "55 %"]}}, or the name of a
    study file. output, progress, options and errors: as for run(), with the options of `clathra study`. After Ctrl-C the same
    call goes on.
    """
    _call("study", plan, output, progress, options)
    return open_study(output)
