"""What the scripts that run `nonet` many times share: where its data is, what decides its answers, what it says."""
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def data_beside(program):
    """Where a program finds params/ and skills/ by itself, as src/agent/data_folder.cpp has it; else here."""
    for folder in pathlib.Path(program).resolve().parents:
        for data in (folder, folder / "share/nonet"):
            if (data / "params").is_dir() and (data / "skills").is_dir():
                return data
    return ROOT


def data_files(data):
    return sorted(f for folder in ("params", "skills") for f in (data / folder).rglob("*") if f.is_file())


def data_of(program):
    """The data folder that a program plays with where no option names one."""
    return pathlib.Path(os.environ.get("NONET_DATA") or data_beside(program))


def fingerprint(files):
    """Of the bytes of these files: of the program and of all that it plays with, so that no run mixes two states."""
    try:
        return hashlib.sha256(b"".join(hashlib.sha256(f.read_bytes()).digest() for f in files)).hexdigest()[:16]
    except OSError as trouble:
        sys.exit(f"cannot read {trouble.filename}: name the program with --nonet, its data with NONET_DATA")


def claim(file, plan, refusal):
    """Writes what a folder is for into this file of it; ends the program with `refusal` where it is for something else."""
    file.parent.mkdir(parents=True, exist_ok=True)
    if file.exists() and json.loads(file.read_text()) != plan:
        sys.exit(refusal)
    file.write_text(json.dumps(plan, indent=1) + "\n")


def output_of(command):
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError((done.stderr.strip().splitlines() or [f"exit code {done.returncode}"])[-1])
    return done.stdout


def demand(program):
    """Ends with what to do when there is no such program."""
    if not program.exists():
        sys.exit(f"{program}: not there; build it with scripts/build.sh release nonet")


def run_each(items, run, jobs, done):
    """`run(item)` for all, so many at a time; after each `done(how many are done, its result)`. A failure ends it."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as workers:
        waiting = [workers.submit(run, item) for item in items]
        try:
            for count, future in enumerate(concurrent.futures.as_completed(waiting), 1):
                done(count, future.result())
        except BaseException:
            workers.shutdown(wait=False, cancel_futures=True)
            raise
