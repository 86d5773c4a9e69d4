#!/usr/bin/env python3
"""Checks the include rules. A file of include/nonet/<module> or src/<module> may include headers of its own module
and of the modules that MODULES allows. Where PARTS has the module, the same holds for its sub-folders. A namespace has
one type of a name at most, anywhere in the project: no compiler sees two that are never included together, and the linker
takes the functions of one for both."""
import pathlib
import re
import sys

CHAIN = ["math", "config", "model", "protocol", "world", "motion", "team", "agent"]
MODULES = {
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
    "env": CHAIN + ["sim", "lab"],
    "app": CHAIN + ["sim", "lab"],
}
# Sub-folder: the sub-folders that it may include. TOP is the module's own folder.
TOP = "."
PARTS = {
    "sim": {
        "physics": [],
        "settings": ["physics"],
        "sensors": ["physics", "settings"],
        "referee": ["physics", "settings"],
        TOP: ["physics", "settings", "sensors", "referee"],
        "server": ["physics", "settings", "sensors", "referee", TOP],
        "fidelity": ["physics", "sensors"],
    },
    "lab": {
        "common": [],
        "trial": ["common"],
        "tasks": ["common", "trial"],
        "optimize": ["common", "trial", "tasks"],
        "match": ["common"],
        "env": ["common", "trial"],
        "reports": ["common", "trial", "tasks", "optimize", "match"],
        TOP: ["common", "trial", "tasks", "optimize", "match", "env", "reports"],
    },
}
INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')
NAMESPACE = re.compile(r"^(?:inline )?namespace ?([\w:]*) ?\{|^\}  // namespace")
TYPE = re.compile(r"^(?:template <.*> )?(?:struct|class|union|enum class|enum) (\w+)(?: final)?(?: :[^;]*)? \{")


def place(parts):
    """Module and sub-folder of a path that begins with the module: ("sim", "physics") or ("sim", TOP)."""
    return parts[0], parts[1] if len(parts) > 2 else TOP


def included(name, root):
    """The path of a project header within include/nonet or src; None for a header of somebody else's or one that
    lies beside its includer."""
    if name.startswith("nonet/"):
        return name.split("/")[1:]
    return name.split("/") if (root / "src" / name).is_file() else None


def problem_of(name, module, part, root):
    """What is wrong with a file of `part` in `module` including `name`; None if nothing is."""
    if name.startswith(".."):
        return f"{name}: no paths that climb; use nonet/<module>/..."
    path = included(name, root)
    if path is None:
        return None
    target, target_part = place(path)
    if target not in MODULES:
        return f"{name}: no such module"
    if target not in [module, *MODULES[module]]:
        return f"{module} must not include {target} ({name})"
    order = PARTS.get(module)
    if target == module and order and target_part not in [part, *order[part]]:
        may = ", ".join(f"{module}/{other}" for other in order[part]) or "no other sub-folder"
        return f"{module}/{part} must not include {module}/{target_part} ({name}); it may include {may}"
    return None


def problems_in(path, relative, root):
    """Line and problem of all that is wrong with one file; `relative` begins with the module."""
    module, part = place(relative.parts)
    if module not in MODULES:
        return [(1, f"folder '{module}' is not a module")]
    if part not in PARTS.get(module, [part]):
        return [(1, f"'{part}' is not a sub-folder of {module}; PARTS in check_includes.py has them")]
    text = path.read_text(encoding="utf-8")
    found = []
    for number, line in enumerate(text.splitlines(), 1):
        match = INCLUDE.match(line)
        problem = problem_of(match.group(1), module, part, root) if match else None
        if problem:
            found.append((number, problem))
    if path.suffix == ".h" and "#pragma once" not in text:
        found.append((1, "#pragma once is missing"))
    return found


def types_in(text):
    """Line and full name of each type that is defined right in a named namespace."""
    spaces, found = [], []
    for number, line in enumerate(text.splitlines(), 1):
        space = NAMESPACE.match(line)
        if space and space.group(0).startswith("}"):
            del spaces[-1:]
        elif space:
            spaces.append(space.group(1))
        match = TYPE.match(line)
        if match and all(spaces):
            found.append((number, "::".join([*spaces, match.group(1)])))
    return found


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    found, files, types = [], 0, {}
    for folder in ("include/nonet", "src"):
        for path in sorted((root / folder).rglob("*")):
            if path.suffix in (".h", ".cpp") and path.is_file():
                files += 1
                problems = problems_in(path, path.relative_to(root / folder), root)
                here = path.relative_to(root)
                for line, name in types_in(path.read_text(encoding="utf-8")):
                    if name in types:
                        problems.append((line, f"{name} stands in {types[name]} as well"))
                    types.setdefault(name, f"{here}:{line}")
                found += [f"{here}:{line}: {problem}" for line, problem in problems]
    for problem in found:
        print(problem)
    print(f"check: includes {'ok' if not found else 'BAD'} ({files} files, {len(found)} problems)")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
