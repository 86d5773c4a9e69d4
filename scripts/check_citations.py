#!/usr/bin/env python3
"""Follows every citation in comments, tests, scripts, skills and documents.

  server facts 2.4            a numbered heading of docs/server-facts.md; also 1.2, 2.4 or 5.1-5.3 or 4.2 and 4.3, and
                              "server facts 7.1, quirk 12", a row of the table there
  [MacAlpine 2012a]           an entry of docs/references.md; [MacAlpine 2012a, section 4.2] names the place in it
  B-Human, pagmo, ...         programs and teams (NAMES below) need an entry in the last list of docs/references.md
  `src/sim/...`, [x](y.md#z)  in documents: paths exist, links and their anchors lead somewhere

A source named in any other way (a venue with a year, a name with a year, "et al.", "the champion's paper") is a finding:
it gets an entry and a key. --self-test shows that each kind of finding is found."""
import argparse
import pathlib
import re
import subprocess
import sys
import tempfile

NAMES = ("B-Human", "Ceres", "Drake", "FC Portugal", "HULKs", "MuJoCo", "ODE", "Pinocchio", "RoboViz", "SimSpark",
         "Stockfish", "UT Austin Villa", "librcsc", "magmaOffenburg", "pagmo", "rcssserver3d", "sfsexp", "simdjson")
SUFFIXES = (".h", ".cpp", ".py", ".sh", ".md", ".skl", ".toml", ".txt", ".cmake", ".html", ".js")
SKIPPED = ("LICENSE", "tests/data/", "scripts/check_citations.py")

NUMBER = r"\d+(?:\.\d+)?"
FACTS = re.compile(rf"\bfacts,?\s+(?:sections?\s+)?({NUMBER}(?:(?:,\s*(?:and\s+)?|\s+and\s+|\s+to\s+|\s*-\s*){NUMBER})*)"
                   r"(?:,?\s+quirk\s+(\d+))?", re.I)
KEY = re.compile(r"\[([A-Z][A-Za-z-]+\s\d{4}[a-z]?)(?:,[^\]]*)?\]")
NAME = re.compile(r"(?<![\w/.:-])(" + "|".join(map(re.escape, NAMES)) + r")(?![\w-])")
NO_AUTHOR = ("January|February|March|April|May|June|July|August|September|October|November|December|RoboCup|In|Since|"
             "Until|After|Before|Of|From|Debian|Copyright")
LOOSE = [re.compile(pattern) for pattern in (
    r"\b(?:AAMAS|AAAI|ICRA|IROS|IJCAI|GECCO|SIGGRAPH|NeurIPS|ICML|Humanoids)\b.{0,3}\d{2,4}",
    r"\barXiv\b",
    r"\bet al\b",
    rf"\b(?!(?:{NO_AUTHOR})\b)[A-Z][a-z]{{2,}},?\s\(?(?:19|20)\d\d\b",
    r"\b[A-Z][a-z]+, \"[A-Z]",
    r"\b[A-Z][a-z]+ and [A-Z][a-z]+ \d+\.\d",
    r"champion's paper|published-figures|simspark-facts|\bdesign\.md\b",
)]
# Good where the same file has named the work by its key.
BACK = re.compile(r"\b(?:the|that|this) (?:paper|tutorial)\b")
LINK = re.compile(r"\]\(([^)\s]+)\)")
PATH = re.compile(r"`((?:src|include|tests|scripts|docs|params|skills|\.ci)/[\w./*-]+)`")


def blocks(path, text):
    """(first line, text) of what belongs together: comments that follow each other in C++, paragraphs elsewhere. The
    text keeps its line breaks, but not the marks of the comments."""
    comment = re.compile(r"(?:^|\s)//+!?\s?(.*)$") if path.suffix in (".h", ".cpp", ".js") else None
    first, lines = 1, []
    for number, line in enumerate(text.split("\n") + [""], 1):
        if comment:
            found = comment.search(line)
            line = found.group(1) if found else ""
        elif path.suffix != ".md":
            line = re.sub(r"^\s*#+!?\s?", "", line)
        if line.strip():
            if not lines:
                first = number
            lines.append(line)
        elif lines:
            yield first, "\n".join(lines)
            lines = []


def numbered_headings(markdown):
    return set(re.findall(rf"^##+ ({NUMBER})\.?\s", markdown, re.M))


def quirks(markdown):
    """Section -> numbers in the first column of its table."""
    found, section = {}, ""
    for line in markdown.split("\n"):
        heading = re.match(rf"##+ ({NUMBER})", line)
        section = heading.group(1) if heading else section
        row = re.match(r"\| (\d+) \|", line)
        if row:
            found.setdefault(section, set()).add(row.group(1))
    return found


def anchors(markdown):
    """As GitHub makes them from headings."""
    names = set()
    for heading in re.findall(r"^#+ (.*)$", markdown, re.M):
        names.add(re.sub(r"[^\w\s-]", "", heading.lower()).strip().replace(" ", "-"))
    return names


class Sources:
    """What can be cited."""

    def __init__(self, root):
        facts = (root / "docs/server-facts.md").read_text(encoding="utf-8")
        references = (root / "docs/references.md").read_text(encoding="utf-8")
        self.facts = numbered_headings(facts)
        self.quirks = quirks(facts)
        entries = re.findall(r"^- \*\*\[?([^\]*]+)\]?\*\*", references, re.M)
        self.keys = set(entries)
        self.doubled = {key for key in entries if entries.count(key) > 1}


def problems_in_text(path, text, sources):
    """(line, what is wrong) for each citation that leads nowhere."""
    references = path.name == "references.md"
    known = bool(KEY.search(re.sub(r"\n\s*(?://+)?\s*", " ", text)))
    for first, block in blocks(path, text):
        def line_of(match, first=first, block=block):
            return first + block.count("\n", 0, match.start())

        for match in FACTS.finditer(block):
            numbers = re.findall(NUMBER, match.group(1))
            for number in numbers:
                if number not in sources.facts:
                    yield line_of(match), f"server facts {number}: no such heading in docs/server-facts.md"
            if match.group(2) and match.group(2) not in sources.quirks.get(numbers[-1], ()):
                yield line_of(match), f"server facts {numbers[-1]} have no quirk {match.group(2)}"
        for match in KEY.finditer(block):
            key = re.sub(r"\s", " ", match.group(1))
            if key not in sources.keys:
                yield line_of(match), f"[{key}]: no such entry in docs/references.md"
        for match in NAME.finditer(block):
            if match.group(1) not in sources.keys:
                yield line_of(match), f"{match.group(1)}: no such entry in docs/references.md"
        if references:
            continue
        # Same length, so that lines stay where they are.
        rest = LINK.sub(lambda m: " " * len(m.group(0)), KEY.sub(lambda m: " " * len(m.group(0)), block))
        for pattern in LOOSE:
            for match in pattern.finditer(rest):
                quoted = re.sub(r"\s+", " ", match.group(0))
                yield line_of(match), f"'{quoted}': cite by a key of docs/references.md, [Name Year, place]"
        for match in BACK.finditer(rest):
            if not known:
                yield line_of(match), f"'{match.group(0)}': which one? This file cites none by its key"


def problems_in_document(path, text, root):
    """Links and paths of a Markdown file."""
    for number, line in enumerate(text.split("\n"), 1):
        for target in LINK.findall(line):
            if "://" in target or target.startswith("mailto:"):
                continue
            name, _, anchor = target.partition("#")
            file = (path.parent / name).resolve() if name else path
            if not file.exists():
                yield number, f"link to {target}: no such file"
            elif anchor and anchor not in anchors(file.read_text(encoding="utf-8")):
                yield number, f"link to {target}: no such heading"
        for name in PATH.findall(line):
            name = name.rstrip("/.")
            if re.search(r"[A-Z]{4}", name.split("/", 1)[1]) and "README" not in name:
                continue  # a placeholder: `src/FOLDER`
            if not (any(root.glob(name)) if "*" in name else (root / name).exists()):
                yield number, f"`{name}`: no such file"


def files_of(root):
    listed = subprocess.run(["git", "ls-files", "-co", "--exclude-standard"], cwd=root, text=True, check=False,
                            stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout.split("\n")
    if listed == [""]:  # not a checkout
        listed = [str(path.relative_to(root)) for path in root.rglob("*") if root / "build" not in path.parents]
    for name in sorted(set(listed)):
        path = root / name
        if name.startswith(SKIPPED) or not path.is_file():
            continue
        if path.suffix in SUFFIXES or name == ".ci/run":
            yield path


def problems(root, files):
    sources = Sources(root)
    found = [f"docs/references.md: two entries '{key}'" for key in sorted(sources.doubled)]
    for path in files:
        text = path.read_text(encoding="utf-8")
        name = path.relative_to(root)
        here = list(problems_in_text(path, text, sources))
        if path.suffix == ".md":
            here += problems_in_document(path, text, root)
        found += [f"{name}:{line}: {what}" for line, what in sorted(here)]
    return found


GOOD = """// Server facts 1.2 and 2.1-2.2; server
// facts 7.1, quirk 2. As in [Graf
// 2009, section III]; the paper has more. Drake. double facts[2] = {1.0, 2.0};
"""
BAD = {
    "// server\n// facts 9.9": "server facts 9.9",
    "// (facts 1.2, 2.7)": "server facts 2.7",
    "// server facts 2.1-2.3": "server facts 2.3",
    "// server facts 7.1, quirk 3": "quirk 3",
    "// [Nobody 1999, section 2]": "[Nobody 1999]",
    "// as HULKs do": "HULKs",
    "// (AAMAS 2012, section 4)": "AAMAS 2012",
    "// Thrun, Burgard, Fox (2005)": "Fox (2005",
    "// Clinger 1990": "Clinger 1990",
    "// Bartels, Beatty, \"An Introduction": "Beatty",
    "// Abramowitz and Stegun 26.7.5": "Stegun",
    "// MacAlpine et al. say": "et al",
    "// 2011 champion's paper": "champion's paper",
    "// which the paper lacks": "which one",
}
BAD_DOCUMENT = {"see [x](no.md)": "no such file", "see [x](server-facts.md#no)": "no such heading",
                "`src/no/file.cpp`": "no such file"}


def self_test():
    """Each kind of finding is found, and nothing in what is good."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "docs").mkdir()
        (root / "docs/server-facts.md").write_text(
            "# Facts\n## 1. Wire\n### 1.2 Order\n## 2. Robot\n### 2.1 Types\n### 2.2 Bodies\n### 7.1 Quirks\n| 2 | odd |\n")
        (root / "docs/references.md").write_text("# R\n- **[Graf 2009]** ...\n- **Drake**: ...\n")

        def findings(name, text):
            (root / name).write_text(text)
            return problems(root, [root / name])

        failures = [f"good text, yet: {line}" for line in findings("good.cpp", GOOD)]
        failures += [f"good link, yet: {line}" for line in
                     findings("docs/good.md", "[a](server-facts.md#12-order) `docs/*.md`")]
        for name, cases in (("bad.cpp", BAD), ("docs/bad.md", BAD_DOCUMENT)):
            for text, expected in cases.items():
                found = findings(name, text + "\n")
                if len(found) != 1 or expected not in found[0]:
                    failures.append(f"{text!r}: expected one finding with {expected!r}, got {found}")
    for line in failures:
        print(f"self-test: {line}")
    print(f"check: citations self-test {'ok' if not failures else 'BAD'} ({len(BAD) + len(BAD_DOCUMENT)} bad texts)")
    return 1 if failures else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--self-test", action="store_true", help="check the check, not the repository")
    if parser.parse_args().self_test:
        return self_test()
    root = pathlib.Path(__file__).resolve().parent.parent
    files = list(files_of(root))
    found = problems(root, files)
    for line in found:
        print(line)
    print(f"check: citations {'ok' if not found else 'BAD'} ({len(files)} files, {len(found)} problems)")
    return 1 if found or not files else 0


if __name__ == "__main__":
    sys.exit(main())
