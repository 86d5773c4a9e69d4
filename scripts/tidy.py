#!/usr/bin/env python3
"""Runs clang-tidy over src/*.cpp, two files at a time, those first that changed last. A file that passed is not looked
at again until it, a header of the project, the compile command or .clang-tidy changes (stamps in BUILD/tidy). The exit
code is 1 if anything is found; files for which the time (--limit) was too short are only counted."""
import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import threading
import time

INCLUDE = re.compile(r'^\s*#\s*include\s*"([^"]+)"', re.M)


def project_headers(path, root, seen):
    """All headers of the project that `path` reaches, itself included."""
    if path in seen or not path.is_file():
        return
    seen.add(path)
    for name in INCLUDE.findall(path.read_text(encoding="utf-8")):
        for folder in (root / "include", root / "src", path.parent):
            if (folder / name).is_file():
                project_headers((folder / name).resolve(), root, seen)
                break


def plain(entry):
    """The command without the precompiled header of g++, which clang cannot read; every file includes what it uses."""
    command = re.sub(r" -Winvalid-pch| -fpch-preprocess| -include \S+cmake_pch\.hxx", "", entry["command"])
    return {**entry, "command": command}


def fingerprint(entry, root):
    digest = hashlib.sha256(entry["command"].encode())
    digest.update((root / ".clang-tidy").read_bytes())
    files = set()
    project_headers(pathlib.Path(entry["file"]), root, files)
    for path in sorted(files):
        digest.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def by_last_change(entries, root):
    """Sorted so that a file comes first if it or its own header was changed last; without a history as they are."""
    log = subprocess.run(["git", "log", "--format=", "--name-only"], cwd=root, text=True, stdout=subprocess.PIPE,
                         stderr=subprocess.DEVNULL, check=False).stdout
    age = {}
    for name in log.split("\n"):
        age.setdefault(name, len(age))

    def last_change(entry):
        source = str(pathlib.Path(entry["file"]).relative_to(root))
        header = source.removesuffix(".cpp") + ".h"
        names = (source, header, "include/nonet/" + header.removeprefix("src/"))
        return min(age.get(name, len(age)) for name in names)

    return sorted(entries, key=last_change)


def check(entry, root, stamps, deadline):
    """The file, whether it passed (None: no time for it), and the findings."""
    stamp = stamps / fingerprint(entry, root)
    if stamp.exists():
        return entry["file"], True, ""
    left = deadline - time.monotonic()
    if left <= 0:
        return entry["file"], None, ""
    try:
        run = subprocess.run(["clang-tidy", "--quiet", "-p", str(stamps), entry["file"]], cwd=root, text=True,
                             stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False,
                             timeout=left if left < threading.TIMEOUT_MAX else None)
    except subprocess.TimeoutExpired:
        return entry["file"], None, ""
    if run.returncode == 0:
        stamp.touch()
    return entry["file"], run.returncode == 0, run.stdout


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", default="build/dev", help="folder with compile_commands.json")
    parser.add_argument("-j", type=int, default=min(2, os.cpu_count() or 1), help="files at a time")
    parser.add_argument("--limit", type=float, default=math.inf, help="seconds")
    parser.add_argument("pattern", nargs="?", default="", help="only files whose path contains this")
    options = parser.parse_args()
    build = (root / options.build).resolve()
    entries = [plain(entry) for entry in json.loads((build / "compile_commands.json").read_text())
               if pathlib.Path(entry["file"]).is_relative_to(root / "src") and options.pattern in entry["file"]]
    stamps = build / "tidy"
    stamps.mkdir(exist_ok=True)
    (stamps / "compile_commands.json").write_text(json.dumps(entries))
    deadline = time.monotonic() + options.limit
    bad = 0
    unchecked = 0
    with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        jobs = [pool.submit(check, entry, root, stamps, deadline) for entry in by_last_change(entries, root)]
        for job in concurrent.futures.as_completed(jobs):
            file, passed, text = job.result()
            if passed is None:
                unchecked += 1
            elif not passed:
                bad += 1
                print(text, flush=True)
                print(f"tidy: {os.path.relpath(file, root)} failed", flush=True)
    late = f", {unchecked} not checked in {options.limit:.0f} s" if unchecked else ""
    print(f"check: tidy {'ok' if not bad else 'BAD'} ({len(entries)} files, {bad} with findings{late})")
    return 1 if bad or not entries else 0


if __name__ == "__main__":
    sys.exit(main())
