#!/usr/bin/env python3
"""Learns by reinforcement on Nonet's environments: an example in the standard library alone.

    python3 scripts/env_example.py                      a robot that stands learns to step ahead, in about a minute
    python3 scripts/env_example.py dribble --steps 100

`nonet_env.VectorEnv` is all that a learner needs (scripts/nonet_env.py). What learns here is small on purpose: the
cross-entropy method on a linear policy. Every environment of the batch tries weights of its own, drawn around a mean;
mean and spread move to those of the best quarter. The policy sees the clock of a stride and, of what the environment
shows, the numbers of seen_of()."""
import argparse
import math
import random
import sys

import nonet_env

STRIDE = 0.4  # s, of the clock
TASKS = ("dribble", "receive", "run")
GAIN = 0.3    # of an action, for a weight of 1


def seen_of(env):
    """The observations that the policy sees."""
    if env.task == "run":  # the lean, behind angle and speed of each joint
        return [2 * env.action_size, 2 * env.action_size + 1]
    return {"dribble": [0, 1, 4, 5], "receive": [0, 1, 2, 3]}[env.task]  # ball and where to; ball, its speed


def features(observation, seen, time):
    phase = 2 * math.pi * time / STRIDE
    return [1.0, math.sin(phase), math.cos(phase), *(observation[number] for number in seen)]


def act(policy, known, actions):
    """The weighted sums of what is known, one for each action."""
    width = len(known)
    return [GAIN * sum(w * x for w, x in zip(policy[i * width:(i + 1) * width], known)) for i in range(actions)]


def returns(env, policies, seen, steps, seed):
    """What each environment earns with its own policy in one episode, or in the first `steps` of it."""
    observations, _ = env.reset(seed)
    earned, over = [0.0] * env.num_envs, [False] * env.num_envs
    still = [0.0] * env.action_size
    for step in range(steps):
        time = step * env.seconds_per_step
        actions = [still if over[i] else act(policies[i], features(observations[i], seen, time), env.action_size)
                   for i in range(env.num_envs)]
        observations, rewards, terminated, truncated, _ = env.step(actions)
        for i in range(env.num_envs):
            if not over[i]:
                earned[i] += float(rewards[i])
                over[i] = bool(terminated[i] or truncated[i])
        if all(over):
            break
    return earned


def learn(env, generations, steps, seed, report=print):
    """The mean return of each generation."""
    draw = random.Random(seed)
    seen = seen_of(env)
    size = env.action_size * (3 + len(seen))
    mean, spread, history = [0.0] * size, [0.3] * size, []
    for generation in range(generations):
        policies = [[draw.gauss(m, s) for m, s in zip(mean, spread)] for _ in range(env.num_envs)]
        earned = returns(env, policies, seen, steps, seed + generation)
        best = sorted(range(env.num_envs), key=lambda number: -earned[number])[:max(2, env.num_envs // 4)]
        for i in range(size):
            chosen = [policies[number][i] for number in best]
            mean[i] = sum(chosen) / len(chosen)
            wide = math.sqrt(sum((w - mean[i]) ** 2 for w in chosen) / len(chosen))
            spread[i] = max(0.02, 0.5 * spread[i] + 0.5 * wide)
        history.append(sum(earned) / len(earned))
        report(f"generation {generation}: mean {history[-1]:.3f}, best {earned[best[0]]:.3f}")
    return history


class _Toy:
    """An environment that pays for actions which are a linear function of what it shows, in one step."""
    task, num_envs, action_size, seconds_per_step = "receive", 60, 2, 0.4

    def reset(self, seed):
        self._draw = random.Random(seed)
        return self._show(), {}

    def _show(self):
        self._seen = [self._draw.uniform(-1, 1) for _ in range(4)]  # the same for all, so that they can be compared
        return [self._seen] * self.num_envs

    def step(self, actions):
        x = self._seen
        wanted = (0.2 * x[0] - 0.1 * x[3], 0.15 - 0.1 * x[1])
        rewards = [-sum((a - w) ** 2 for a, w in zip(action, wanted)) for action in actions]
        never = [False] * self.num_envs
        return self._show(), rewards, never, never, {}


class _Runner:
    task = "run"

    def __init__(self, joints):
        self.action_size = joints


def self_test():
    assert [seen_of(_Runner(joints)) for joints in (22, 24)] == [[44, 45], [48, 49]]
    history = learn(_Toy(), 60, 20, 1, lambda text: None)
    assert history[0] < -1.0, history[0]
    assert history[-1] > history[0] / 10, history
    still = returns(_Toy(), [[0.0] * 14] * 60, seen_of(_Toy()), 20, 7)
    assert max(still) < -0.4 and min(still) == max(still), still
    print(f"env_example: the policy is found ({history[0]:.2f} to {history[-1]:.2f})")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", nargs="?", default="run", choices=TASKS)
    parser.add_argument("--type", type=int, default=0, help="robot type")
    parser.add_argument("--envs", type=int, default=48)
    parser.add_argument("--steps", type=int, default=100, help="of an episode, at most")
    parser.add_argument("--generations", type=int, default=40)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--self-test", action="store_true")
    parser.add_argument("--exact", action="store_true", help="exact stepper instead of the quick one")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    try:
        with nonet_env.VectorEnv(arguments.task, arguments.envs, robot_type=arguments.type,
                                 quick=not arguments.exact) as env:
            learn(env, arguments.generations, arguments.steps, arguments.seed,
                  lambda text: print(text, flush=True))
    except nonet_env.Error as problem:
        sys.exit(f"env_example: {problem}")


if __name__ == "__main__":
    main()
