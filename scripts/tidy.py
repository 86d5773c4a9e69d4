#!/usr/bin/env python3
"""Runs clang-tidy over src/*.cpp, two files at a time. A file that passed is not looked at again until it, a header
of the project, the compile command or .clang-tidy changes (stamps in BUILD/tidy)."""
import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys

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


def fingerprint(entry, root):
    digest = hashlib.sha256(entry["command"].encode())
    digest.update((root / ".clang-tidy").read_bytes())
    files = set()
    project_headers(pathlib.Path(entry["file"]), root, files)
    for path in sorted(files):
        digest.update(str(path.relative_to(root)).encode() + b"\0" + path.read_bytes())
    return digest.hexdigest()


def check(entry, root, build, stamps):
    stamp = stamps / fingerprint(entry, root)
    if stamp.exists():
        return entry["file"], 0, ""
    run = subprocess.run(["clang-tidy", "--quiet", "-p", str(build), entry["file"]], cwd=root, text=True,
                         stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    if run.returncode == 0:
        stamp.touch()
    return entry["file"], run.returncode, run.stdout


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", default="build/dev", help="folder with compile_commands.json")
    parser.add_argument("-j", type=int, default=min(2, os.cpu_count() or 1), help="files at a time")
    parser.add_argument("pattern", nargs="?", default="", help="only files whose path contains this")
    options = parser.parse_args()
    build = (root / options.build).resolve()
    entries = [entry for entry in json.loads((build / "compile_commands.json").read_text())
               if pathlib.Path(entry["file"]).is_relative_to(root / "src") and options.pattern in entry["file"]]
    stamps = build / "tidy"
    stamps.mkdir(exist_ok=True)
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(options.j) as pool:
        for file, code, text in pool.map(lambda entry: check(entry, root, build, stamps), entries):
            if code != 0:
                bad += 1
                print(text, flush=True)
                print(f"tidy: {os.path.relpath(file, root)} failed", flush=True)
    print(f"check: tidy {'ok' if not bad else 'BAD'} ({len(entries)} files, {bad} with findings)")
    return 1 if bad or not entries else 0


if __name__ == "__main__":
    sys.exit(main())
