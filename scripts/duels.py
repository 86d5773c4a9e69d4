#!/usr/bin/env python3
"""Duels between two states of the program: who takes a ball that lies half a metre before both two metres ahead.

  python3 scripts/duels.py --b ../before/build/release/nonet --out logs/duels2 --type 2 --trials 100
  python3 scripts/duels.py --a ../mine/build/release/nonet --b ../before/build/release/nonet --out logs/duels0

The situation is that of `nonet ball-report --skill duel`, whose opponent can have other parameters but not another program.
Here every robot is an agent of its own executable, on the embedded server in lock-step, with the data beside it; a trainer
puts robots and ball into their places. A and B change sides from duel to duel. A duel ends when the ball has gone two metres
towards either goal or left the field, at the latest after 20 s; what is not decided counts half. One that was stopped goes on
with the same command; a folder belongs to two programs, a type and a seed, and another one is refused."""
import argparse
import json
import math
import os
import pathlib
import random
import re
import socket
import struct
import subprocess
import sys
import tempfile
import time

from nonet_program import ROOT, claim, data_beside, data_files, demand, fingerprint, run_each

UNUM = 7  # any but the goalie's
APART = 0.5  # m from the ball
GAIN = 2.0  # m
LONGEST = 20.0  # s
PREPARATION = 2.0  # s to look about before the trainer comes
DOWN = 0.55  # of the standing height
PLAY_ON = 3  # the mode's number
PER_MESSAGE = 0.04  # s of the game
PATIENCE = 60.0  # s without a message

PARTS = re.compile(r"\(SLT ([^)]*)\)|\(load ([^)\s]+)|\(resetMaterials ([^)]*)\)|\(time ([^)]*)\)|\(play_mode ([^)]*)\)")


def picture(text):
    """Time, mode, place of the ball and each side's torso, [x, y, z] in m, of a full message of the monitor port; else None."""
    if "(RSG " not in text[:4000]:
        return None
    place, mesh, found = [0.0, 0.0, 0.0], "", {"torso": {}}
    for matrix, load, materials, seconds, mode in PARTS.findall(text):
        if matrix:
            moved = [float(number) for number in matrix.split()[12:15]]
            place = moved if any(moved) else place  # a mesh is only turned in its body
        elif load:
            mesh = load
            if load.endswith("soccerball.obj"):
                found["ball"] = place
        elif materials and "naobody" in mesh:
            side = "Left" if "matLeft" in materials else "Right" if "matRight" in materials else None
            if side:
                found["torso"][side] = place
        elif seconds:
            found["time"] = float(seconds)
        elif mode:
            found["mode"] = int(mode)
    return found if {"ball", "time", "mode"} <= set(found) else None


class Trainer:
    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=PATIENCE)
        self.messages = 0

    def tell(self, *commands):
        self.socket.sendall(b"".join(struct.pack(">I", len(c)) + c.encode() for c in commands))

    def look(self):
        self.tell("(reqfullstate)")
        while True:
            seen = picture(self.read(struct.unpack(">I", self.read(4))[0]).decode("latin1"))
            self.messages += 1
            if seen:
                return seen

    def read(self, size):
        data = b""
        while len(data) < size:
            part = self.socket.recv(size - len(data))
            if not part:
                raise OSError("the server has gone")
            data += part
        return data


def scene(seed, trial):
    """Ball and direction of the duel, drawn as duelOnce in lab/trial/ball_trial.cpp does."""
    draw = random.Random(f"{seed} {trial}")
    return draw.uniform(-6.0, 6.0), draw.uniform(-5.0, 5.0), draw.uniform(-0.7, 0.7)


def placing(seen, x, y, heading):
    """What the trainer says for it; the opponent stands towards its own goal."""
    commands = ["(playMode PlayOn)", f"(ball (pos {x:.3f} {y:.3f} 0.042)(vel 0 0 0))"]
    for side, sign, turn in (("Left", -1, heading), ("Right", 1, heading + math.pi)):
        at = (x + sign * APART * math.cos(heading), y + sign * APART * math.sin(heading), seen["torso"][side][2] + 0.005)
        commands.append(f"(agent (team {side})(unum {UNUM})(move {at[0]:.3f} {at[1]:.3f} {at[2]:.3f} "
                        f"{math.degrees(turn) - 90.0:.2f}))")
    return commands


def fight(trainer, x, y, heading):
    """Who won for the left side, 1 or 0, after how long, and who fell."""
    entered = None
    while entered is None or (trainer.messages - entered) * PER_MESSAGE < PREPARATION:
        seen = trainer.look()
        if entered is None and len(seen["torso"]) == 2:
            entered = trainer.messages
    heights = {side: place[2] for side, place in seen["torso"].items()}
    trainer.tell(*placing(seen, x, y, heading))
    begin, fell = None, {side: False for side in heights}
    while True:
        seen = trainer.look()
        ahead, aside = seen["ball"][0] - x, seen["ball"][1] - y
        if begin is None:
            if seen["mode"] != PLAY_ON or math.hypot(ahead, aside) > 0.5 * GAIN:
                continue
            begin = seen["time"]
        for side, place in seen["torso"].items():
            fell[side] |= place[2] < DOWN * heights[side]
        gone = seen["time"] - begin
        if abs(ahead) >= GAIN or seen["mode"] != PLAY_ON or gone > LONGEST:
            won = 0.5 if abs(ahead) < GAIN else float(ahead > 0.0)
            return {"won": won, "s": round(gone, 2), "fell": [fell["Left"], fell["Right"]]}


def free_ports():
    sockets = [socket.socket() for _ in range(2)]
    try:
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]
    finally:
        for each in sockets:
            each.close()


def connected(port, server):
    for _ in range(200):
        try:
            return Trainer(port)
        except OSError:
            if server.poll() is not None:
                break
            time.sleep(0.05)
    raise OSError("the server does not answer")


def play(options, trial):
    """One duel, as side A sees it."""
    a_left = trial % 2 == 0
    port, monitor = free_ports()
    seed = str(options.seed * 100000 + trial)
    sides = [("A", options.a), ("B", options.b)]
    with tempfile.TemporaryDirectory() as folder:
        processes = []

        def start(name, *command):
            with open(pathlib.Path(folder) / name, "w") as log:
                processes.append(subprocess.Popen([str(word) for word in command], stdout=log, stderr=log))

        try:
            start("server", options.nonet, "serve", "--sync", "--players", 2, "--port", port, "--monitor-port", monitor,
                  "--seed", seed, "--left", "A" if a_left else "B", "--right", "B" if a_left else "A")
            trainer = connected(monitor, processes[0])
            for team, program in sides:
                start(team, program, "play", "--host", "127.0.0.1", "--port", port, "--unum", UNUM, "--team", team,
                      "--type", options.type)
            result = fight(trainer, *scene(options.seed, trial))
        except OSError as trouble:
            logs = [(f.name, f.read_text().strip().splitlines()) for f in sorted(pathlib.Path(folder).iterdir())]
            said = "; ".join(f"{name}: {lines[-1]}" for name, lines in logs if lines)
            raise RuntimeError(f"duel {trial}: {trouble}; {said}") from trouble
        finally:
            for process in processes:
                process.kill()
                process.wait()
    if not a_left:
        result = {**result, "won": 1.0 - result["won"], "fell": result["fell"][::-1]}
    return {"trial": trial, **result}


def summary(duels):
    count = len(duels)
    won = sum(duel["won"] for duel in duels) / count
    spread = math.sqrt(sum((duel["won"] - won) ** 2 for duel in duels) / count / count)
    falls = [sum(duel["fell"][side] for duel in duels) for side in range(2)]
    return {"duels": count, "a_won": round(won, 4), "ci95": round(1.96 * spread, 4),
            "undecided": sum(duel["won"] == 0.5 for duel in duels), "a_fell": falls[0], "b_fell": falls[1],
            "mean_s": round(sum(duel["s"] for duel in duels) / count, 2)}


def text_of(result):
    return (f"{result['duels']} duels: A won {100 * result['a_won']:.1f} +- {100 * result['ci95']:.1f} % (95 %), "
            f"{result['undecided']} undecided; fell in {result['a_fell']} (A) and {result['b_fell']} (B); "
            f"{result['mean_s']:.1f} s in the mean")


def state_of(program):
    return {"program": str(program), "fingerprint": fingerprint([program, *data_files(data_beside(program))])}


def duels_of(file):
    """Those that are kept, by number; a line that a kill has torn is played again."""
    duels = {}
    for line in file.read_text().splitlines() if file.exists() else []:
        try:
            duel = json.loads(line)
        except json.JSONDecodeError:
            continue
        duels[duel["trial"]] = duel
    return duels


def self_test():
    torso = "(nd TRF (SLT 1 0 0 0 0 1 0 0 0 0 1 0 {} 1)(nd TRF (SLT 0 0 1 0 1 0 0 0 0 1 0 0 0 0 0 1)" \
            "(nd StaticMesh (load models/naobody2.obj)(sSc 0.1 0.1 0.1)(resetMaterials matNum7 {} naowhite))))"
    ball = "(nd TRF (SLT 1 0 0 0 0 1 0 0 0 0 1 0 {} 1)(nd StaticMesh (load models/soccerball.obj)))"
    text = "((time 12.5)(play_mode 3))(RSG 0 1)(" + ball.format("1.5 -2 0.042") + torso.format("1 -2 0.4", "matLeft") + \
        torso.format("2 -2 0.2", "matRight") + ")"
    seen = picture(text)
    assert seen == {"time": 12.5, "mode": 3, "ball": [1.5, -2.0, 0.042],
                    "torso": {"Left": [1.0, -2.0, 0.4], "Right": [2.0, -2.0, 0.2]}}, seen
    assert picture("((time 12.5))(RDS 0 1)()") is None
    commands = placing(seen, 1.0, 2.0, 0.0)
    assert commands[2] == "(agent (team Left)(unum 7)(move 0.500 2.000 0.405 -90.00))", commands[2]
    assert commands[3] == "(agent (team Right)(unum 7)(move 1.500 2.000 0.205 90.00))", commands[3]

    class Recorded:
        """Left pushes the ball 2 m ahead; right falls on the way."""
        messages, told = 0, None

        def look(self):
            self.messages += 1
            ahead = 0.0 if self.told is None else 0.1 * (self.messages - self.told)
            return {"time": 0.04 * self.messages, "mode": 0 if self.told is None else 3, "ball": [1.0 + ahead, 2.0, 0.042],
                    "torso": {"Left": [0.5, 2.0, 0.4], "Right": [1.5, 2.0, 0.4 if ahead < 1.0 else 0.1]}}

        def tell(self, *commands):
            self.told = self.messages
    trainer = Recorded()
    result = fight(trainer, 1.0, 2.0, 0.0)
    assert trainer.told * PER_MESSAGE >= PREPARATION
    assert result == {"won": 1.0, "s": 0.76, "fell": [False, True]}, result
    lost = {"won": 0.0, "s": 1.0, "fell": [True, False]}
    found = summary([result, result, result, lost])
    assert (found["a_won"], found["a_fell"], found["b_fell"]) == (0.75, 1, 3), found
    assert abs(found["ci95"] - 1.96 * math.sqrt(0.75 * 0.25 / 4)) < 1e-4, found
    assert scene(1, 2) == scene(1, 2) != scene(1, 3)
    with tempfile.TemporaryDirectory() as folder:
        kept = pathlib.Path(folder) / "duels.jsonl"
        assert duels_of(kept) == {}
        kept.write_text(json.dumps({"trial": 4, **lost}) + "\n" + json.dumps({"trial": 5, **lost})[:20])
        assert list(duels_of(kept)) == [4]
    print("duels: all well")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--a", type=pathlib.Path, default=ROOT / "build/release/nonet", help="executable of side A")
    parser.add_argument("--b", type=pathlib.Path, help="executable of side B, of an older commit say")
    parser.add_argument("--nonet", type=pathlib.Path, default=ROOT / "build/release/nonet", help="executable of the server")
    parser.add_argument("--type", type=int, default=2, choices=range(5), help="robot type of both")
    parser.add_argument("--trials", type=int, default=100, help="duels in all")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=max(1, (os.cpu_count() or 2) // 2), help="duels at a time")
    parser.add_argument("--out", type=pathlib.Path, help="folder for the duels")
    parser.add_argument("--json", action="store_true", help="print JSON")
    parser.add_argument("--self-test", action="store_true", help="test this script")
    options = parser.parse_args()
    if options.self_test:
        return self_test()
    if options.b is None or options.out is None:
        parser.error("--b and --out are needed")
    if options.trials < 1 or options.jobs < 1:
        parser.error("--trials and --jobs must be 1 or more")
    for program in (options.a, options.b, options.nonet):
        demand(program)
    os.environ.pop("NONET_DATA", None)  # every program plays with the data beside it
    options.a, options.b, options.nonet = (each.resolve() for each in (options.a, options.b, options.nonet))
    plan = {"a": state_of(options.a), "b": state_of(options.b), "type": options.type, "seed": options.seed}
    claim(options.out / "state.json", plan, f"{options.out} holds duels of other programs, type or seed; name another --out")
    kept = options.out / "duels.jsonl"
    duels = duels_of(kept)
    kept.write_text("".join(json.dumps(duel) + "\n" for duel in duels.values()))
    missing = [trial for trial in range(options.trials) if trial not in duels]
    with kept.open("a") as file:
        def keep(_, duel):
            duels[duel["trial"]] = duel
            file.write(json.dumps(duel) + "\n")
            file.flush()
            print(f"{len(duels)} of {options.trials}", file=sys.stderr)

        try:
            run_each(missing, lambda trial: play(options, trial), options.jobs, keep)
        except RuntimeError as trouble:
            sys.exit(str(trouble))
    result = summary([duels[trial] for trial in range(options.trials)])
    print(json.dumps(result) if options.json else text_of(result))
    return None


if __name__ == "__main__":
    main()
