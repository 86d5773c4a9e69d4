#!/usr/bin/env python3
"""Plays games in which each of many changes is made or not by the throw of a coin, and tells what each of them did.

  python3 scripts/screen.py CHANGES --out logs/screen --pairs 200
  python3 scripts/screen.py CHANGES --out logs/screen --against own wall ../before --share 0.3
  python3 scripts/screen.py CHANGES --out logs/screen --scrums 8 --pairs 500 --type 2
  python3 scripts/screen.py CHANGES --out logs/screen --sieges 8 --pairs 500
  python3 scripts/screen.py --out logs/screen                                only the table of what is there

A line of CHANGES is a name and the parameters of side A that make the change; "#" begins a comment, "|" another way
to make it, which is drawn in its place and stands in the table as closer:2:

  closer   team.ball.behindBall=0.14m | team.ball.behindBall=0.21m
  charge   team.charging.speed=0.45
  backsUp  team.formation.firstBackFromGoal=5m team.formation.secondBackFromGoal=8m

Thirty changes cost as many games as one: every game tells of all of them. The effects, in goals (for minus against)
per ten minutes, are those of least squares with a constant for each opponent; beside them the standard error. A second
table tells what else each change does: goals against, shots on target, passes, possession, falls, charging fouls. Of
thirty changes without any effect one or two show two standard errors, so what is found here is then played alone, by
`nonet series --sprt`. No two lines may set the same parameter. A screening that was stopped goes on with the same
command. Games are played on the quick stepper unless --exact is given.

With --scrums a pair is so many scrums instead of two games (`nonet ball-report --skill scrum`): three robots a side
around a contested ball, and what counts is how many metres it gains. That tells far more in the same time, of what
is done near the ball and of nothing else. --against then names data folders, or own. With --sieges it is so many attacks
on a wall (`--skill siege`: four of ours, ball 3 to 10 m before the goal), and what counts is the share with a goal."""
import argparse
import concurrent.futures
import json
import math
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import threading

import nonet_program
from nonet_program import ROOT, data_beside, data_files, output_of


def read_changes(path, refusal):
    """{name: [assignment, ...]}, with "name:1", "name:2" for two ways; ends the program at a line that cannot be used:
    `refusal` tells why the program would not take these assignments, or nothing."""
    changes, owner = {}, {}
    try:
        text = pathlib.Path(path).read_text()
    except OSError as trouble:
        sys.exit(f"{path}: {trouble.strerror}")
    for number, line in enumerate(text.splitlines(), 1):
        name, *rest = line.split("#")[0].split(maxsplit=1) or [None]
        if name is None:
            continue
        ways = [way.split() for way in "".join(rest).split("|")]
        if not all(ways) or any("=" not in a for way in ways for a in way) or ":" in name:
            sys.exit(f"{path}:{number}: a change is a name without ':' and key=value, one or more; '|' between its ways")
        if name in owner.values():
            sys.exit(f"{path}:{number}: '{name}' is there twice")
        for key in (a.split("=")[0] for way in ways for a in way):
            if owner.setdefault(key, name) != name:
                sys.exit(f"{path}:{number}: '{owner[key]}' sets {key} too; no two lines may set the same parameter")
        if trouble := refusal([assignment for way in ways for assignment in way]):
            sys.exit(f"{path}:{number}: {trouble}")
        for i, way in enumerate(ways, 1):
            changes[f"{name}:{i}" if len(ways) > 1 else name] = way
    if not changes:
        sys.exit(f"{path}: no change in it")
    return changes


def refusal(assignments, nonet):
    """What the program says against parameters, before any game; None if it takes them."""
    command = [nonet, "params"] + [word for assignment in assignments for word in ("--set", assignment)]
    try:
        output_of(command)
    except (RuntimeError, OSError) as trouble:
        return str(trouble).removeprefix("nonet: ")
    return None


def drawn(changes, pair, share):
    """The changes of a pair: the same whoever asks, and whenever."""
    chance = random.Random(pair)
    ways = {}
    for name in changes:
        ways.setdefault(name.split(":")[0], []).append(name)
    return [names[0] if len(names) == 1 else chance.choice(names)
            for names in ways.values() if chance.random() < share]


def solve(matrix, columns):
    """Gauss-Jordan with pivots: X with matrix X = columns; a direction without information ends the program."""
    n = len(matrix)
    rows = [list(a) + list(b) for a, b in zip(matrix, columns)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        if abs(rows[pivot][i]) < 1e-9:
            raise ArithmeticError("too few games to tell the changes apart")
        rows[i], rows[pivot] = rows[pivot], rows[i]
        rows[i] = [value / rows[i][i] for value in rows[i]]
        for r in range(n):
            if r != i and rows[r][i]:
                factor = rows[r][i]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[i])]
    return [row[n:] for row in rows]


def effects(games, names, opponents):
    """games: (opponent, changes made, goal difference); [(name, effect, standard error)], in goals of such a game."""
    design = [[float(g[0] == o) for o in opponents] + [float(n in g[1]) for n in names] for g in games]
    width = len(opponents) + len(names)
    if len(games) <= width:
        raise ArithmeticError(f"{len(games)} pairs of games; more than {width} are needed")
    normal = [[sum(x[i] * x[j] for x in design) for j in range(width)] for i in range(width)]
    unit = [[float(i == j) for j in range(width)] for i in range(width)]
    inverse = solve(normal, unit)
    moments = [sum(x[i] * g[2] for x, g in zip(design, games)) for i in range(width)]
    fit = [sum(a * b for a, b in zip(row, moments)) for row in inverse]
    rest = sum((g[2] - sum(a * b for a, b in zip(x, fit))) ** 2 for x, g in zip(design, games))
    variance = rest / (len(games) - width)
    return [(n, fit[i], math.sqrt(variance * inverse[i][i])) for i, n in enumerate(names, len(opponents))]


def opponent_files(word):
    """What decides how an opponent plays that is a folder or another program; a word is of our own data."""
    path = pathlib.Path(word)
    if word == "own" or not path.exists():
        return []
    return data_files(path) if path.is_dir() else [path, *data_files(data_beside(path))]


def fingerprint(program, against):
    """Of the program, of what it plays with and of its opponents, so that no screening mixes two."""
    return nonet_program.fingerprint([pathlib.Path(program), *data_files(nonet_program.data_of(program)),
                                      *(f for word in against for f in opponent_files(word))])


def scenes(pair, made, opponent, changes, settings):
    """Some scrums or sieges by `nonet ball-report`: their record."""
    scene = settings.scene
    command = [settings.nonet, "ball-report", "--skill", scene, "--trials", str(getattr(settings, scene + "s")),
               "--threads", "1", "--type", str(settings.type), "--seed", str(pair), "--json"]
    command += [] if settings.exact else ["--quick"]
    command += [] if opponent == "own" else ["--opponent-data", opponent]
    for assignment in (a for name in made for a in changes[name]):
        command += ["--set", assignment]
    report = json.loads(output_of(command))
    return {"pair": pair, "against": opponent, "changes": made,
            scene: {column: report[key]["mean"] for column, key in SCENES[scene].items()}}


def play(pair, made, opponent, changes, settings):
    """One pair of games by `nonet series`: its record."""
    if settings.scene:
        return scenes(pair, made, opponent, changes, settings)
    folder = settings.out / "pairs" / str(pair)
    command = [settings.nonet, "series", "own", opponent, "--pairs", "1", "--jobs", "1", "--seed", str(pair),
               "--minutes", str(settings.minutes), "--out", str(folder)]
    command += [] if settings.exact else ["--set", "QuickSolver=true"]
    assignments = [a for name in made for a in changes[name]]
    command += ["--a-set", *assignments] if assignments else []
    output_of(command)
    lines = [json.loads(line) for line in (folder / "matches.jsonl").read_text().splitlines()]
    return {"pair": pair, "against": opponent, "changes": made, "minutes": settings.minutes,
            "goals": [[line["score_a"], line["score_b"]] for line in lines]}


def play_all(changes, settings, done):
    """Plays what is missing of the pairs; each is written as it ends."""
    stop = threading.Event()
    missing = [p for p in range(settings.seed, settings.seed + settings.pairs) if p not in done]

    def one(pair):
        if stop.is_set():
            return None
        opponent = settings.against[pair % len(settings.against)]
        return play(pair, drawn(changes, pair, settings.share), opponent, changes, settings)

    with concurrent.futures.ThreadPoolExecutor(settings.jobs) as pool:
        try:
            games = concurrent.futures.as_completed([pool.submit(one, pair) for pair in missing])
            for number, ended in enumerate(games, 1):
                record = json.dumps(ended.result())
                if fingerprint(settings.nonet, settings.against) != settings.fingerprint:
                    raise RuntimeError("the program, an opponent, params/ or skills/ changed; put them back")
                with (settings.out / "pairs.jsonl").open("a") as file:
                    file.write(record + "\n")
                print(f"{number} of {len(missing)} pairs", file=sys.stderr, flush=True)
        except KeyboardInterrupt:
            stop.set()
            sys.exit("stopped: interrupted; the same command goes on")
        except (RuntimeError, OSError) as trouble:
            stop.set()
            sys.exit(f"stopped: {trouble}; once that is mended the same command goes on")


def read_records(path):
    records = []
    for line in filter(None, path.read_text().splitlines() if path.exists() else []):
        try:
            records.append(json.loads(line))
        except json.JSONDecodeError:
            print(f"{path}: a torn line is left out", file=sys.stderr)
    return records


SCENES = {  # column: key in the report; the first one decides
    "scrum": {
        "gained": "scrum_m",
        "territory": "scrum_territory_m",
        "falls": "scrum_falls",
        "their falls": "scrum_opponent_falls",
        "charging": "scrum_charges",
        "theirs": "scrum_opponent_charges",
    },
    "siege": {
        "goals": "siege_goals",
        "corners": "siege_corners",
        "out": "siege_out",
        "lost": "siege_lost",
        "charging": "siege_charged",
        "theirs": "siege_opponent_charged",
    },
}

MEASURES = {  # of side A in one game, from its statistics, the goals against it and what makes ten minutes of a game
    "against": lambda own, against, ten: ten * against,
    "on target": lambda own, against, ten: ten * own["shots_on_target"],
    "passes": lambda own, against, ten: ten * own["passes_completed"],
    "falls": lambda own, against, ten: ten * own["falls"],
    "charging": lambda own, against, ten: ten * own["fouls"].get("charging", 0),
    "possession": lambda own, against, ten: own["possession_percent"],
}


def measured(folder):
    """Means of a pair's games, in ten minutes but for possession; None if they are not there."""
    try:
        games = [json.loads(line) for line in (folder / "matches.jsonl").read_text().splitlines()]
    except (OSError, json.JSONDecodeError):
        return None
    sums = dict.fromkeys(MEASURES, 0.0)
    for game in games:
        own = game["statistics"]["teams"][0 if game["a"] == "left" else 1]
        for name, measure in MEASURES.items():
            sums[name] += measure(own, game["score_b"], 600 / game["game_time_s"])
    return {name: value / len(games) for name, value in sums.items()} if games else None


def also_table(pairs, names, what):
    """What else the changes do, in the order of `names`: effects, and in brackets in standard errors. `pairs` are records
    with their values by column."""
    opponents = sorted({r["against"] for r, _ in pairs})
    if len(pairs) <= len(opponents) + len(names):
        return ""
    columns = list(pairs[0][1])
    found = {c: {name: (effect, effect / max(error, 1e-9)) for name, effect, error in
                 effects([(r["against"], set(r["changes"]), values[c]) for r, values in pairs], names, opponents)}
             for c in columns}
    lines = ["", f"{len(pairs)} {what}, in brackets in standard errors",
             " " * 16 + "".join(f"{c:>15}" for c in columns),
             f"{'mean':16}" + "".join(f"{sum(v[c] for _, v in pairs) / len(pairs):8.2f}       " for c in columns)]
    for name in names:
        lines.append(f"{name:16}" + "".join(f"{found[c][name][0]:+8.2f} ({found[c][name][1]:+4.1f})" for c in columns))
    return "\n".join(line.rstrip() for line in lines)


def scene_of(record):
    """Its name and its values; of a pair of games None."""
    return next(((name, record[name]) for name in SCENES if name in record), None)


def value_of(record):
    """What decides: metres in a scrum, the share of sieges with a goal, or goals in ten minutes."""
    if scene := scene_of(record):
        return next(iter(scene[1].values()))
    return 10 / record["minutes"] * sum(a - b for a, b in record["goals"]) / len(record["goals"])


def table(records, names, out):
    # A pair is what was drawn: its games share seed and changes.
    games = [(r["against"], set(r["changes"]), value_of(r)) for r in records]
    opponents = sorted({g[0] for g in games})
    found = effects(games, names, opponents)
    scene = next((found[0] for found in map(scene_of, records) if found), None)
    what = {"scrum": "draws of scrums; metres gained", "siege": "draws of sieges; share with a goal",
            None: "pairs of games; goals per ten minutes"}[scene]
    digits = 3 if scene == "siege" else 2
    lines = [f"{len(games)} {what} that each change adds, standard error, their ratio"]
    found.sort(key=lambda e: -e[1] / max(e[2], 1e-9))
    for name, effect, error in found:
        made = sum(name in g[1] for g in games)
        lines.append(f"{name:16} {effect:+6.{digits}f} {error:5.{digits}f} {effect / max(error, 1e-9):+5.1f}   "
                     f"in {made} pairs")
    names = [name for name, _, _ in found]
    if scene:
        pairs = [(r, dict(list(r[scene].items())[1:])) for r in records]
        also = also_table(pairs, names, f"draws: what else they change in a {scene}, for a side")
    else:
        pairs = [(r, measured(out / "pairs" / str(r["pair"]))) for r in records]
        also = also_table([(r, values) for r, values in pairs if values], names,
                          "pairs: what else they change in ten minutes (possession: %)")
    return "\n".join(lines) + "\n" + also


def self_test():
    """Effects that are known are found within their errors; so are none where there are none."""
    names = [f"c{i}" for i in range(12)]
    truth = {"c3": 1.0, "c7": -0.6}
    changes = {name: [f"{name}=1"] for name in names}
    chance, games, scores = random.Random(5), [], []
    for pair in range(400):
        made, opponent = set(drawn(changes, pair, 0.4)), ("weak", "strong")[pair % 2]
        mean = (3.0 if opponent == "weak" else 0.5) + sum(truth.get(n, 0) for n in made)
        games += [(opponent, made, chance.gauss(mean, 1.2)) for _ in range(2)]
    for name, effect, error in effects(games, names, ["weak", "strong"]):
        scores.append((effect - truth.get(name, 0)) / error)
        assert 0.06 < error < 0.12, (name, error)
    assert max(map(abs, scores)) < 3.5, scores
    assert 0.4 < math.sqrt(sum(s * s for s in scores) / len(scores)) < 1.6, scores
    ways = {"a:1": ["a=1"], "a:2": ["a=2"], "b": ["b=1"]}
    both = [set(drawn(ways, pair, 0.6)) for pair in range(300)]
    assert not any({"a:1", "a:2"} <= made for made in both)
    assert all(60 < sum(name in made for made in both) < 120 for name in ("a:1", "a:2"))
    exact = [("a", {"x"} if i % 2 else set(), 2.0 + 3.0 * (i % 2)) for i in range(9)]
    assert abs(effects(exact, ["x"], ["a"])[0][1] - 3) < 1e-9
    for few in (games[:5], [("a", {"x"}, 1.0)] * 9):
        try:
            effects(few, ["x"], ["a"])
        except ArithmeticError:
            continue
        raise AssertionError("games that tell nothing were not refused")
    game = {"a": "right", "score_b": 1, "game_time_s": 300, "statistics": {"teams": [
        None, {"shots_on_target": 3, "passes_completed": 2, "falls": 4, "fouls": {}, "possession_percent": 60}]}}
    with tempfile.TemporaryDirectory() as folder:
        assert measured(pathlib.Path(folder)) is None
        (pathlib.Path(folder) / "matches.jsonl").write_text(json.dumps(game) + "\n")
        values = measured(pathlib.Path(folder))
    expected = {"against": 2, "on target": 6, "passes": 4, "falls": 8, "charging": 0, "possession": 60}
    assert values == expected, values
    scene = {"changes": [], "siege": {"goals": 0.25, "out": 0.5}}
    assert value_of(scene) == 0.25 and value_of({"changes": [], "scrum": {"gained": -1.5, "falls": 2}}) == -1.5
    sieges = [{"against": "own", "changes": ["x"] if i % 2 else [], "siege": {"goals": 0.2 + 0.1 * (i % 2), "out": i}}
              for i in range(9)]
    assert "x                +0.100" in table(sieges, ["x"], None), table(sieges, ["x"], None)
    test_fingerprint()
    test_changes()
    print("screen: known effects found")


def test_fingerprint():
    """It changes with the program, its own data and each opponent that is a file or a folder, and with nothing else."""
    kept = os.environ.pop("NONET_DATA", None)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        parts = {f"{tree}/{part}": tree for tree in ("now", "before", "other")
                 for part in ("params/type0.toml", "skills/a.skl", "build/nonet")}
        for part in parts:
            (folder / part).parent.mkdir(parents=True, exist_ok=True)
            (folder / part).write_text("x")
        program, against = str(folder / "now/build/nonet"), ["own", "wall", str(folder / "before")]
        last = fingerprint(program, against)
        for part, tree in parts.items():
            (folder / part).write_text("y")
            now = fingerprint(program, against)
            assert (now != last) == (tree == "now" or (tree == "before" and "build" not in part)), part
            last = now
        older = [str(folder / "other/build/nonet")]
        last = fingerprint(program, older)
        for part in ("other/build/nonet", "other/params/type0.toml"):
            (folder / part).write_text("z")
            assert fingerprint(program, older) != last, part
            last = fingerprint(program, older)
        os.environ["NONET_DATA"] = str(folder / "other")
        last = fingerprint(program, ["own"])
        (folder / "now/params/type0.toml").write_text("z")
        assert fingerprint(program, ["own"]) == last
        (folder / "other/params/type0.toml").write_text("w")
        assert fingerprint(program, ["own"]) != last
    os.environ.pop("NONET_DATA")
    if kept is not None:
        os.environ["NONET_DATA"] = kept


def test_changes():
    """A line that cannot be used is named, also one that the program does not take."""
    def read(text):
        with tempfile.NamedTemporaryFile("w", suffix=".txt") as file:
            file.write(text)
            file.flush()
            try:
                return read_changes(file.name, lambda assignments: "unknown" if "b=1" in assignments else None)
            except SystemExit as end:
                return str(end).removeprefix(file.name)
    assert read("# none\nx a=1 | a=2\ny c=1 d=2\n") == {"x:1": ["a=1"], "x:2": ["a=2"], "y": ["c=1", "d=2"]}
    assert read("x a=1\n\ny c=1 | b=1\n") == ":3: unknown"
    assert read("x a=1\ny a=2\n").startswith(":2: 'x' sets a too")
    assert "/no/nonet" in refusal(["a=1"], "/no/nonet")


def screen(settings):
    settings.fingerprint = fingerprint(settings.nonet, settings.against)
    changes = read_changes(settings.changes, lambda assignments: refusal(assignments, settings.nonet))
    plan = {"changes": changes, "share": settings.share, "minutes": settings.minutes, "against": settings.against,
            "exact": settings.exact, "fingerprint": settings.fingerprint}
    if settings.scene:
        trials = settings.scene + "s"
        plan |= {trials: getattr(settings, trials), "type": settings.type}
    nonet_program.claim(settings.out / "plan.json", plan,
                        f"{settings.out} holds another screening (other changes or options, or the program, an opponent, "
                        "params/ or skills/ changed since); name another --out")
    records = settings.out / "pairs.jsonl"
    done = {record["pair"] for record in read_records(records)}
    if records.exists() and not records.read_text().endswith("\n"):
        with records.open("a") as file:
            file.write("\n")
    play_all(changes, settings, done)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("changes", nargs="?", help="file with the changes")
    parser.add_argument("--out", type=pathlib.Path, help="folder; a screening that is there already goes on")
    parser.add_argument("--pairs", type=int, default=100, help="pairs of games (100)")
    parser.add_argument("--minutes", type=float, default=3, help="game time of one game (3)")
    parser.add_argument("--against", nargs="+", help="sides B, in turn (own wall; in scenes own)")
    scene = parser.add_mutually_exclusive_group()
    scene.add_argument("--scrums", type=int, default=0, help="so many scrums instead of a pair of games")
    scene.add_argument("--sieges", type=int, default=0, help="so many sieges instead")
    parser.add_argument("--type", type=int, default=2, help="of the robots in scrums and sieges (2)")
    parser.add_argument("--share", type=float, default=0.5, help="of the pairs in which a change is made (0.5)")
    parser.add_argument("--seed", type=int, default=1, help="of the first pair; each has the next one (1)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="pairs at a time (one per core)")
    parser.add_argument("--exact", action="store_true", help="the exact stepper; three to four times slower")
    parser.add_argument("--nonet", default=str(ROOT / "build/release/nonet"), help="the program")
    parser.add_argument("--self-test", action="store_true")
    settings = parser.parse_args()
    if settings.self_test:
        return self_test()
    if not settings.out:
        parser.error("needs --out")
    settings.scene = "scrum" if settings.scrums else "siege" if settings.sieges else None
    settings.against = settings.against or (["own"] if settings.scene else ["own", "wall"])
    if settings.changes:
        screen(settings)
    elif not (settings.out / "plan.json").exists():
        sys.exit(f"{settings.out}: no screening there; name a file with changes")
    try:
        print(table(read_records(settings.out / "pairs.jsonl"),
                    list(json.loads((settings.out / "plan.json").read_text())["changes"]), settings.out))
    except ArithmeticError as trouble:
        sys.exit(f"{trouble}; play more pairs")


if __name__ == "__main__":
    main()
