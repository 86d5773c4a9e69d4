#!/usr/bin/env python3
"""Measures one robot of each type in everything docs/results.md says of it, and prints the tables.

  python3 scripts/measure.py --out logs/measured                       all of it: about an hour and a half of one core
  python3 scripts/measure.py --out logs/measured --only kicks pushed   some sections
  python3 scripts/measure.py --out logs/quick --share 0.1              a tenth of the trials
  python3 scripts/measure.py --out logs/mine --data ../mine            another team's data folder
  python3 scripts/measure.py --list                                    the sections and their commands; runs nothing

A section is a table with the command that gave it. Each command's answer is kept in the folder, so a run that was stopped
goes on with the same command, and the folder's tables.md holds all tables that are complete. A folder belongs to one
state of the program, of the data and of the trials; another one is refused."""
import argparse
import datetime
import hashlib
import json
import pathlib
import shlex
import sys
import tempfile

from nonet_program import ROOT, claim, data_files, data_of, demand, fingerprint, output_of, run_each

TYPES = range(5)


def percent(share):
    return f"{100.0 * share:.1f}".removesuffix(".0") + " %"


class Section:
    """One table: for every row `command(row)` is run; `cells` makes named rows of cells from its JSON answer."""

    def __init__(self, title, head, command, cells, rows=TYPES, row_name=lambda row: str(row)):
        self.title, self.head, self.command, self.cells, self.rows, self.row_name = title, head, command, cells, rows, row_name

    def table(self, answers):
        lines = ["| " + " | ".join(self.head) + " |", "|" + "---|" * len(self.head)]
        for row in self.rows:
            for name, cells in self.cells(self.row_name(row), answers[row]):
                lines.append("| " + " | ".join([name, *cells]) + " |")
        return "\n".join(lines)


def rows_of_one(cells):
    """Cells for a table with one row for each answer."""
    return lambda name, answer: [(name, cells(answer))]


def of_kick(kick):
    return [f"{kick['distance_m']['mean']:.1f} m", f"{kick['distance_m']['p10']:.1f} m", percent(kick["under_2m"]),
            f"{kick['direction_error_deg']['mean']:.1f} deg", f"{kick['time_s']['mean']:.2f} s", percent(kick["falls"])]


KICK_HEAD = ["mean", "a tenth is below", "under 2 m", "direction off", "time", "falls"]


def of_walk(walk):
    course = walk["course"]
    return [f"{walk['forward_10s_mps']['mean']:.3f} m/s", f"{walk['backward_mps']['mean']:.3f} m/s",
            f"{walk['sideways_mps']['mean']:.3f} m/s", f"{walk['turn_degps']['mean']:.0f} deg/s",
            f"{walk['falls']} of {walk['trials']}", str(course["falls"]), str(course["change_falls"]),
            f"{course['time_s']:.1f} s"]


def of_rise(rise):
    return [f"{side['first_try']} of {side['falls']}, {side['median_s']:.2f} s, {side['self_collisions']}"
            for side in (rise[key] for key in ("front", "back", "side"))]


def seconds(value):
    return f"{value:.2f} s"


def speed(value):
    return f"{value:.2f} m/s"


def of_ball(skill, **figures):
    """Means of a ball report, each written by its function, and the falls of the skill."""
    return rows_of_one(lambda ball: [*(write(ball[key]["mean"]) for key, write in figures.items()),
                                     str(ball["falls_of"][skill])])


def of_saves(saves):
    return [percent(saves["saved_share"]), percent(saves["rolling"]["saved_share"]), percent(saves["flying"]["saved_share"]),
            str(saves["own_goals"]), f"{saves['up_after_fall']} of {saves['falls']}"]


def kicks_of_type(name, answer):
    """One row for each kick of a robot type."""
    return [(name, [kick.removeprefix("kick_"), *of_kick(of)]) for kick, of in answer.items()]


def of_one_kick(kick_name, cells):
    """Cells for a table of one kick, without the types that do not have it."""
    return lambda name, answer: [(name, cells(answer[kick_name]))] if kick_name in answer else []


def of_pass(kick):
    return [f"{kick['asked_m']:.0f} m", f"{kick['distance_m']['mean']:.2f} m", percent(kick["under_2m"]),
            f"{kick['direction_error_deg']['mean']:.1f} deg", percent(kick["falls"])]


def of_chip(kick):
    return [percent(kick["clears"]), f"{kick['height_1m_m']['mean']:.2f} m", *of_kick(kick)]


def sections(trials):
    """The sections by name; `trials(n)` is how many of n are wanted."""
    def report(command, cells, head, title, **more):
        return Section(title, ["Robot type", *head], command, cells, **more)

    def kick(options, count=200):
        return lambda row: f"kick-report --type {row} {options} --trials {trials(count)} --seed 11"

    def ball(skill, count, quick=""):
        return lambda row: f"ball-report --type {row} --skill {skill}{quick} --trials {trials(count)} --seed 9"

    distances = [(type_, metres) for type_ in TYPES for metres in (2, 3, 4, 5, 6)]
    return {
        "walk": report(lambda row: f"walk-report --type {row} --trials {trials(10)} --courses {trials(100)}",
                       rows_of_one(of_walk),
                       ["forward, ten seconds from a stand", "backward", "sideways", "turning", "falls in walks",
                        "falls in courses", "while sets change", "course"], "The walk"),
        "rising": report(lambda row: f"rise-report --type {row} --falls {trials(100)}", rows_of_one(of_rise),
                         ["front", "back", "side"], "Rising: first attempts, median time, limbs that collide"),
        "kicks": report(kick("--kick all"), kicks_of_type, ["kick", *KICK_HEAD], "Kicks, from 0.5 m"),
        "kicks-far": report(kick("--kick all --start 1.5", 100), kicks_of_type, ["kick", *KICK_HEAD], "Kicks, from 1.5 m"),
        "pushed": report(kick("--kick kick_power --pushed 1"), of_one_kick("kick_power", of_kick), KICK_HEAD,
                         "kick_power at a ball that rolls away at 1 m/s"),
        "chips": report(kick("--kick all"), of_one_kick("kick_chip", of_chip),
                        ["high and down in time", "height a metre on", *KICK_HEAD], "Chips"),
        "passes": report(lambda row: f"kick-report --type {row[0]} --kick kick_pass --distance {row[1]} --trials {trials(100)} "
                                     "--seed 11", of_one_kick("kick_pass", of_pass),
                         ["asked", "mean", "under 2 m", "direction off", "falls"],
                         "Passes of a distance on demand", rows=distances, row_name=lambda row: str(row[0])),
        "approach": report(ball("approach", 200, " --quick"), of_ball("approach", approach_s=seconds, approach_share=percent),
                           ["time", "in place", "falls"], "Approach from 1.5 m"),
        "run": report(ball("run", 200), of_ball("run", run_mps=speed, stop_s=seconds),
                      ["beyond 3 m, for 3 s", "stop", "falls"], "Run, and stop from it"),
        "dribble": report(ball("dribble", 100), of_ball("dribble", dribble_mps=speed, dribble_kept=percent),
                          ["speed", "kept", "falls"], "Dribble over 10 m"),
        "slalom": report(ball("slalom", 100), of_ball("slalom", slalom_mps=speed, slalom_arrived=percent, slalom_kept=percent,
                                                      slalom_near=percent),
                         ["speed", "to the end", "kept", "near", "falls"], "Slalom"),
        "receive": report(ball("receive", 100), of_ball("receive", receive_share=percent), ["held", "falls"], "Receive"),
        "drive": report(ball("drive", 200), of_ball("drive", drive_m=lambda way: f"{way:.1f} m", drive_goals=percent),
                        ["in 15 s", "goals", "falls"], "driveBallToGoal"),
        "duel": report(ball("duel", 400, " --quick"), of_ball("duel", duel_share=percent, duel_open=percent),
                       ["won", "open", "with a fall"], "Duel among equals"),
        "saves": report(lambda row: f"save-report --type {row} --trials {trials(250)} --seed 9", rows_of_one(of_saves),
                        ["saved", "rolling", "flying", "own goals", "up after a fall"], "The goalie", rows=[0]),
    }


def answer_of(program, command, data, file):
    """The JSON of one command, from its file if it is there."""
    if file.exists():
        return json.loads(file.read_text())
    line = [program, *shlex.split(command), "--json", "--threads", "1", *(["--data", str(data)] if data else [])]
    try:
        output = output_of(line)
    except RuntimeError as trouble:
        sys.exit(f"{shlex.join(line)}: {trouble}")
    answer = json.loads(output)
    partial = file.with_suffix(".part")
    partial.write_text(output)
    partial.rename(file)
    return answer


def file_of(out, command):
    return out / (hashlib.sha256(command.encode()).hexdigest()[:16] + ".json")


def page(sections_, out, state):
    """Those sections whose answers are all there, as Markdown."""
    parts = [f"`{state['program']}`, {datetime.date.today().strftime('%-d %B %Y')}\n"]
    for section in sections_.values():
        commands = {row: section.command(row) for row in section.rows}
        files = {row: file_of(out, command) for row, command in commands.items()}
        if all(file.exists() for file in files.values()):
            how = " to ".join(f"`nonet {command}`" for command in dict.fromkeys([*commands.values()][::len(commands) - 1 or 1]))
            answers = {row: json.loads(file.read_text()) for row, file in files.items()}
            parts.append(f"## {section.title}\n\n{how}\n\n{section.table(answers)}\n")
    return "\n".join(parts)


def self_test():
    def number(mean):
        return {"mean": mean, "p10": mean - 1.0, "median": mean}
    kick = {"asked_m": 4.0, "distance_m": number(12.34), "under_2m": 0.005, "direction_error_deg": number(1.5),
            "time_s": number(1.3), "falls": 0.0, "clears": 0.9, "height_1m_m": number(0.8)}
    few = sections(lambda n: max(1, n // 10))
    assert few["kicks"].command(3) == "kick-report --type 3 --kick all --trials 20 --seed 11"
    table = few["kicks"].table({type_: {"kick_power": kick, "kick_side": kick} for type_ in TYPES}).splitlines()
    assert len(table) == 2 + 2 * len(TYPES), table
    assert table[3] == "| 0 | side | 12.3 m | 11.3 m | 0.5 % | 1.5 deg | 1.30 s | 0 % |", table[3]
    lengths = {line.count("|") for line in table}
    assert len(lengths) == 1, "as many cells as heads"
    assert few["passes"].table({row: {"kick_pass": kick} for row in few["passes"].rows}).count("| 4 m | 12.34 m |") == 25
    with tempfile.TemporaryDirectory() as folder:
        out = pathlib.Path(folder) / "out"
        program = pathlib.Path(folder) / "nonet"
        program.write_text("#!/bin/sh\necho run >> \"$(dirname \"$0\")/runs\"\n[ \"$1\" = save-report ] || exit 3\n"
                           "echo '{\"saved_share\": 0.5}'\n")
        program.chmod(0o755)
        claim(out / "state.json", {"program": "one"}, "another state")
        for _ in range(2):  # the second time from the file
            assert answer_of(str(program), "save-report", None, file_of(out, "save-report")) == {"saved_share": 0.5}
        assert (program.parent / "runs").read_text() == "run\n"
        for wrong in (lambda: claim(out / "state.json", {"program": "two"}, "another state"),
                      lambda: answer_of(str(program), "walk-report", None, file_of(out, "walk-report"))):
            try:
                wrong()
            except SystemExit as refusal:
                assert "another state" in str(refusal) or "exit code 3" in str(refusal), refusal
            else:
                raise AssertionError("taken")
        done = []
        run_each(["a", "b"], done.append, 2, lambda count, _: done.append(count))
        assert sorted(map(str, done)) == ["1", "2", "a", "b"]
        side = {"saved_share": 0.5}
        assert page(few, out, {"program": "x"}).count("##") == 0, "nothing is complete"
        file_of(out, few["saves"].command(0)).write_text(json.dumps(
            {"saved_share": 0.6, "rolling": side, "flying": side, "own_goals": 1, "falls": 9, "up_after_fall": 8}))
        assert "| 0 | 60 % | 50 % | 50 % | 1 | 8 of 9 |" in page(few, out, {"program": "x"})
    print("measure: all well")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    names = list(sections(lambda n: n))
    parser.add_argument("--out", type=pathlib.Path, help="folder for answers and tables")
    parser.add_argument("--only", nargs="+", choices=names, default=names, metavar="SECTION", help=", ".join(names))
    parser.add_argument("--share", type=float, default=1.0, help="of the usual trials")
    parser.add_argument("--jobs", type=int, default=2, help="commands at a time")
    parser.add_argument("--nonet", type=pathlib.Path, default=ROOT / "build/release/nonet", help="the program")
    parser.add_argument("--data", type=pathlib.Path, help="folder with params/ and skills/; default: the program's own")
    parser.add_argument("--list", action="store_true", help="only say the commands")
    parser.add_argument("--self-test", action="store_true", help="test this script")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    if options.share <= 0.0 or options.jobs < 1:
        parser.error("--share must be above 0 and --jobs 1 or more")
    whole = sections(lambda n: max(1, round(options.share * n)))
    wanted = {name: whole[name] for name in names if name in options.only}
    if options.list:
        for name, section in wanted.items():
            print(f"{name}: {section.title}", *(f"  nonet {section.command(row)}" for row in section.rows), sep="\n")
        return None
    if options.out is None:
        parser.error("--out is missing")
    demand(options.nonet)
    program = str(options.nonet.resolve())
    data = options.data or data_of(program)
    state = {"program": output_of([program, "--version"]).strip(),
             "fingerprint": fingerprint([options.nonet, *data_files(data)]), "share": options.share}
    claim(options.out / "state.json", state,
          f"{options.out} holds answers of another program, other data or another --share; name another --out")

    commands = list(dict.fromkeys(section.command(row) for section in wanted.values() for row in section.rows))
    tables = options.out / "tables.md"

    def say(count, _):
        print(f"{count} of {len(commands)}", file=sys.stderr)
        tables.write_text(page(whole, options.out, state))

    def run(command):
        return answer_of(program, command, options.data, file_of(options.out, command))

    run_each(commands, run, options.jobs, say)
    print(tables.read_text())
    return None


if __name__ == "__main__":
    main()
