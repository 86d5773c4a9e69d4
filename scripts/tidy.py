#!/usr/bin/env python3
"""Runs clang-tidy over src/*.cpp, two files at a time, those first that changed last. A file that passed is not looked
at again until it, a header of the project, the compile command or .clang-tidy changes (stamps in BUILD/tidy). The exit
code is 1 if anything is found; files for which the time (--limit) was too short are only counted.

--changed-since REV looks only at what changed since the merge base with REV, in commits or not: sources, and for a header
the source of the same name, or else the first one that includes it. On REV itself, and where REV is unknown, the last 20
commits count; without a history everything."""
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

RECENT_COMMITS = 20
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


def git(root, *arguments):
    """What git says; empty where it fails."""
    return subprocess.run(["git", *arguments], cwd=root, text=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                          check=False).stdout.strip()


def base_of(root, revision):
    """The commit after which everything counts as changed; empty without a history."""
    base = git(root, "merge-base", "HEAD", revision)
    if base and base != git(root, "rev-parse", "HEAD"):
        return base
    return git(root, "rev-list", "--first-parent", f"--max-count={RECENT_COMMITS + 1}", "HEAD").split("\n")[-1]


def names_for(source):
    """The source and the two places where its own header can be."""
    header = source.removesuffix(".cpp") + ".h"
    return source, header, "include/nonet/" + header.removeprefix("src/")


def changed_entries(entries, root, revision):
    base = base_of(root, revision)
    if not base:
        return entries
    changed = set(git(root, "diff", "--name-only", base).split("\n"))
    changed.update(git(root, "ls-files", "--others", "--exclude-standard").split("\n"))
    chosen = {}
    left = {name for name in changed if name.endswith(".h") and (root / name).is_file()}
    for entry in entries:
        names = names_for(str(pathlib.Path(entry["file"]).relative_to(root)))
        left.difference_update(names)
        if changed.intersection(names):
            chosen[entry["file"]] = entry
    # Headers without a source of their own are looked at through one of those that include them.
    for name in sorted(left):
        written = name.removeprefix("include/").removeprefix("src/")
        for entry in entries:
            if written in INCLUDE.findall(pathlib.Path(entry["file"]).read_text(encoding="utf-8")):
                chosen[entry["file"]] = entry
                break
    print(f"tidy: {len(chosen)} of {len(entries)} files, changed since {base[:7]}")
    return list(chosen.values())


def by_last_change(entries, root):
    """Sorted so that a file comes first if it or its own header was changed last; without a history as they are."""
    age = {}
    for name in git(root, "log", "--format=", "--name-only").split("\n"):
        age.setdefault(name, len(age))

    def last_change(entry):
        source = str(pathlib.Path(entry["file"]).relative_to(root))
        return min(age.get(name, len(age)) for name in names_for(source))

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


def configured(root):
    """The build folder of the preset tidy, with the files that others include. The dev preset compiles several as one."""
    for command in (["cmake", "--preset", "tidy"], ["cmake", "--build", "--preset", "tidy", "--target", "nonet_commit"]):
        run = subprocess.run(command, cwd=root, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, check=False)
        if run.returncode != 0:
            sys.exit(f"tidy: {' '.join(command)} failed:\n{run.stdout}")
    return root / "build" / "tidy"


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--build", help="folder with compile_commands.json that names each file by itself; "
                        "without it the preset tidy is configured")
    parser.add_argument("-j", type=int, default=min(2, os.cpu_count() or 1), help="files at a time")
    parser.add_argument("--limit", type=float, default=math.inf, help="seconds")
    parser.add_argument("--changed-since", metavar="REV", help="only what changed since the merge base with REV")
    parser.add_argument("pattern", nargs="?", default="", help="only files whose path contains this")
    options = parser.parse_args()
    build = (root / options.build).resolve() if options.build else configured(root)
    entries = [plain(entry) for entry in json.loads((build / "compile_commands.json").read_text())
               if pathlib.Path(entry["file"]).is_relative_to(root / "src") and options.pattern in entry["file"]]
    nothing = not entries
    if options.changed_since:
        entries = changed_entries(entries, root, options.changed_since)
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
    return 1 if bad or nothing else 0


if __name__ == "__main__":
    sys.exit(main())
