#!/usr/bin/env python3
"""Checks the include rules between the modules: a file of include/nonet/<module> or src/<module> may include only
headers of its own module and of those that the table allows."""
import pathlib
import re
import sys

CHAIN = ["math", "config", "model", "protocol", "world", "motion", "team", "agent"]
ALLOWED = {
    "math": [],
    "config": ["math"],
    "model": ["math", "config"],
    "protocol": ["math", "model"],
    "world": ["math", "config", "model", "protocol"],
    "motion": CHAIN[:5],
    "team": CHAIN[:6],
    "agent": CHAIN[:7],
    "sim": ["math", "config", "model", "protocol"],
    "lab": CHAIN + ["sim"],
    "app": CHAIN + ["sim", "lab"],
}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')


def module_of(path):
    """The module a file belongs to, and whether the folder is known."""
    parts = path.parts
    return parts[2] if parts[:2] == ("include", "nonet") else parts[1]


def problems_in(path, module):
    allowed = {module, *ALLOWED[module]}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        name = match.group(1)
        if name.startswith("nonet/"):
            target = name.split("/")[1]
            if target not in ALLOWED:
                yield f"{path}:{number}: {name}: no such module"
            elif target not in allowed:
                yield f"{path}:{number}: {module} must not include {target} ({name})"
        elif name.startswith(".."):
            yield f"{path}:{number}: {name}: no paths that climb; use nonet/<module>/..."
        elif "/" in name and name.split("/")[0] in ALLOWED and name.split("/")[0] not in allowed:
            yield f"{path}:{number}: {module} must not include {name}"


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    found, files = [], 0
    for folder in ("include/nonet", "src"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix not in (".h", ".cpp") or not path.is_file():
                continue
            files += 1
            relative = path.relative_to(root)
            module = module_of(relative)
            if module not in ALLOWED:
                found.append(f"{relative}: folder '{module}' is not a module")
                continue
            found += problems_in(relative, module)
            if path.suffix == ".h" and "#pragma once" not in path.read_text(encoding="utf-8"):
                found.append(f"{relative}: #pragma once is missing")
    for line in found:
        print(line)
    print(f"check: includes {'ok' if not found else 'BAD'} ({files} files, {len(found)} problems)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
