#!/usr/bin/env python3
"""Learns by reinforcement with `nonet env`: an example in the standard library alone.

    python3 scripts/env_example.py dribble --nonet build/release/nonet --generations 20

`NonetEnv` is all that a learner needs: it starts the program and steps a batch of environments. What learns here is
small on purpose: a linear policy, searched at random in all environments of the batch at once.
"""
import argparse
import array
import json
import random
import subprocess


class NonetEnv:
    """A batch of environments; observations and actions are flat arrays of floats, environment by environment."""

    def __init__(self, nonet, task, envs=8, seed=1, options=()):
        command = [nonet, "env", task, "--envs", str(envs), "--seed", str(seed), *options]
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        line = self.process.stdout.readline()
        if not line:
            raise SystemExit(f"{' '.join(command)}: no answer")
        header = json.loads(line)
        self.envs = header["envs"]
        self.observations = header["observations"]
        self.actions = header["actions"]
        self.observation = self._floats(self.envs * self.observations)

    def _read(self, size):
        data = self.process.stdout.read(size)
        if len(data) != size:
            raise SystemExit("nonet env has ended")
        return data

    def _floats(self, count):
        return array.array("f", self._read(4 * count))

    def step(self, actions):
        """Observations, rewards, ends; an environment that has ended shows the begin of its next episode."""
        self.process.stdin.write(array.array("f", actions).tobytes())
        self.process.stdin.flush()
        self.observation = self._floats(self.envs * self.observations)
        return self.observation, self._floats(self.envs), self._read(self.envs)

    def close(self):
        self.process.stdin.close()
        self.process.wait()


def linear(policy, env, number):
    """The actions of one environment: a weighted sum of its observations and 1."""
    seen = [*env.observation[number * env.observations:(number + 1) * env.observations], 1.0]
    width = len(seen)
    return [sum(w * x for w, x in zip(policy[i * width:(i + 1) * width], seen)) for i in range(env.actions)]


def returns(env, policies, steps):
    """What each environment earned with its own policy."""
    earned = [0.0] * env.envs
    for _ in range(steps):
        actions = [a for number in range(env.envs) for a in linear(policies[number], env, number)]
        _, rewards, _ = env.step(actions)
        earned = [sum_ + reward for sum_, reward in zip(earned, rewards)]
    return earned


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", nargs="?", default="dribble")
    parser.add_argument("--nonet", default="build/release/nonet")
    parser.add_argument("--envs", type=int, default=16)
    parser.add_argument("--steps", type=int, default=150, help="of a generation")
    parser.add_argument("--generations", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    env = NonetEnv(arguments.nonet, arguments.task, arguments.envs, arguments.seed)
    draw = random.Random(arguments.seed)
    center = [0.0] * (env.actions * (env.observations + 1))
    for generation in range(arguments.generations):
        policies = [[w + draw.gauss(0.0, 0.2) for w in center] for _ in range(env.envs)]
        earned = returns(env, policies, arguments.steps)
        best = sorted(range(env.envs), key=lambda number: -earned[number])[:max(1, env.envs // 4)]
        center = [sum(policies[number][i] for number in best) / len(best) for i in range(len(center))]
        print(f"generation {generation}: mean {sum(earned) / len(earned):.3f}, best {earned[best[0]]:.3f}")
    env.close()


if __name__ == "__main__":
    main()
