#!/usr/bin/env python3
"""Nonet's trials for learners: a batch of environments in the vector manner of Gymnasium, which is not needed.

    import nonet_env
    env = nonet_env.VectorEnv("run", envs=8, robot_type=2)
    observations, _ = env.reset(seed=1)
    observations, rewards, terminated, truncated, info = env.step(actions)

It calls libnonet_env.so (include/nonet/env/nonet_env.h) in this process. Observations are a matrix of `envs` rows of
32-bit floats, rewards and ends an entry for each environment. With numpy these are arrays, copies of their own; without
it lists (of `array.array` rows). Actions are a matrix of `envs` x `action_size` numbers from -1 to 1, or its numbers in
one row. An episode that has ended is followed by the next at once: the observation is that of its beginning, and
`info["final_obs"]`, there if any has ended, holds the matrix with the last observations of those that ended.

    python3 nonet_env.py --list              the tasks
    python3 nonet_env.py run --bench 5       steps a second of one core; --pipe build/release/nonet: over a pipe as well
    python3 nonet_env.py --self-test         the library is searched for as below; without one only this file is tested

The library is NONET_ENV_LIBRARY, or that of the installation or source tree that this file lies in, or the system's."""
import argparse
import array
import ctypes
import json
import operator
import os
import pathlib
import random
import subprocess
import sys
import time

try:
    import numpy
except ImportError:
    numpy = None

VERSION = 1  # NONET_ENV_VERSION of the header that this file was written for
NAME = "libnonet_env.so"


class Error(Exception):
    """What the library has refused, in its words, or what it cannot even be asked for."""


def _whole(name, value, low, high):
    """The number, which ctypes would cut to its low bits if it were too large."""
    number = operator.index(value)
    if not low <= number <= high:
        raise Error(f"{name} must be {low} to {high}, not {number}")
    return number


def _int32(name, value):
    return _whole(name, value, -2 ** 31, 2 ** 31 - 1)


def _seed(value):
    return _whole("seed", value, 0, 2 ** 64 - 1)


class _Options(ctypes.Structure):
    _fields_ = [("struct_size", ctypes.c_size_t), ("task", ctypes.c_char_p), ("seed", ctypes.c_uint64),
                ("envs", ctypes.c_int32), ("threads", ctypes.c_int32), ("robot_type", ctypes.c_int32),
                ("quick", ctypes.c_int32), ("data_folder", ctypes.c_char_p),
                ("parameters", ctypes.POINTER(ctypes.c_char_p)), ("parameter_count", ctypes.c_size_t)]


class _Sizes(ctypes.Structure):
    _fields_ = [("envs", ctypes.c_size_t), ("observations", ctypes.c_size_t), ("actions", ctypes.c_size_t),
                ("seconds_per_step", ctypes.c_double)]


def library_candidates(here, environment):
    """Where the library may be, best first. `here` is the folder of this file."""
    if environment.get("NONET_ENV_LIBRARY"):
        return [environment["NONET_ENV_LIBRARY"]]
    tree, prefix = here.parent, here.parents[2] if len(here.parents) > 2 else here
    found = [tree / "build" / preset / NAME for preset in ("release", "dev")]
    found += [prefix / "lib" / NAME, *sorted(prefix.glob(f"lib/*/{NAME}"))]
    return [str(path) for path in found if path.is_file()] + [NAME]


def _declare(library):
    number, handle = ctypes.c_size_t, ctypes.c_void_p
    floats, ends = ctypes.POINTER(ctypes.c_float), ctypes.POINTER(ctypes.c_uint8)
    for name, result, *arguments in (
            ("version", ctypes.c_int),
            ("last_error", ctypes.c_char_p),
            ("task_name", ctypes.c_char_p, number),
            ("task_description", ctypes.c_char_p, number),
            ("default_options", ctypes.c_int, ctypes.POINTER(_Options)),
            ("create", ctypes.c_int, ctypes.POINTER(_Options), ctypes.POINTER(handle)),
            ("destroy", None, handle),
            ("get_sizes", ctypes.c_int, handle, ctypes.POINTER(_Sizes)),
            ("reset", ctypes.c_int, handle, ctypes.c_uint64, floats, number),
            ("step", ctypes.c_int, handle, floats, number, floats, number, floats, ends, ends, number),
            ("final_observations", ctypes.c_int, handle, floats, number)):
        function = getattr(library, "nonet_env_" + name)
        function.restype, function.argtypes = result, arguments


_loaded = {}


def load(path=None):
    """The library, opened once; Error if there is none or it speaks another version."""
    candidates = [str(path)] if path else library_candidates(pathlib.Path(__file__).resolve().parent, os.environ)
    key = candidates[0]
    if key not in _loaded:
        try:
            library = ctypes.CDLL(key)
            _declare(library)
        except (OSError, AttributeError) as trouble:
            raise Error(f"{key} cannot be used ({trouble}): build the target nonet_env, or set NONET_ENV_LIBRARY to "
                        "the library's file") from None
        if library.nonet_env_version() != VERSION:
            raise Error(f"{key} has version {library.nonet_env_version()}, this module needs {VERSION}")
        _loaded[key] = library
    return _loaded[key]


def tasks(library=None):
    """{name: description} of all tasks."""
    known, index, lib = {}, 0, load(library)
    while (name := lib.nonet_env_task_name(index)) is not None:
        known[name.decode()] = lib.nonet_env_task_description(index).decode()
        index += 1
    return known


class _Floats:
    """Numbers that the library reads or writes, a matrix for Python."""

    def __init__(self, rows, columns):
        self.rows, self.columns, self.count = rows, columns, rows * columns
        self.values = (ctypes.c_float * self.count)()

    def put(self, matrix):
        """From an array of numpy, rows of numbers, or all numbers in one row."""
        if numpy is not None and isinstance(matrix, numpy.ndarray):
            flat = numpy.ascontiguousarray(matrix, dtype=numpy.float32)
            self._check(flat.size, flat.ndim == 1 or flat.shape == (self.rows, self.columns))
            ctypes.memmove(self.values, flat.ctypes.data, 4 * self.count)
            return
        numbers, fits = list(matrix), True
        if numbers and hasattr(numbers[0], "__len__"):
            fits = [len(row) for row in numbers] == [self.columns] * self.rows
            numbers = [number for row in numbers for number in row]
        self._check(len(numbers), fits)
        ctypes.memmove(self.values, array.array("f", numbers).tobytes(), 4 * self.count)

    def get(self):
        if numpy is not None:
            return numpy.frombuffer(self.values, dtype=numpy.float32).reshape(self.rows, self.columns).copy()
        flat = array.array("f", bytes(self.values))
        return [flat[row * self.columns:(row + 1) * self.columns] for row in range(self.rows)]

    def vector(self):
        return self.get().reshape(self.rows) if numpy is not None else list(self.values)

    def _check(self, count, fits):
        if count != self.count or not fits:
            raise ValueError(f"{count} numbers{'' if fits else ' in other rows'} given, "
                             f"{self.rows} x {self.columns} needed")


def _flags(values):
    return numpy.frombuffer(values, dtype=numpy.uint8).astype(bool) if numpy is not None else [bool(v) for v in values]


class VectorEnv:
    """`num_envs` environments of a task, each showing `observation_size` numbers and taking `action_size` of them.

    `threads` 0: all processors. `parameters` are assignments such as "motion.walk.gait.maxStepX=5cm". The same seed and
    actions give the same numbers, those of `nonet env` with the same options. One thread at a time may use it."""

    def __init__(self, task, envs=1, seed=1, threads=0, robot_type=0, quick=False, data_folder=None, parameters=(),
                 library=None):
        self._handle = ctypes.c_void_p()
        self._library = load(library)
        options = _Options()
        self._call("default_options", options)
        options.task, options.seed = task.encode(), _seed(seed)
        options.envs, options.threads = _int32("envs", envs), _int32("threads", threads)
        options.robot_type, options.quick = _int32("robot_type", robot_type), int(bool(quick))
        options.data_folder = os.fsencode(data_folder) if data_folder else None
        options.parameters = (ctypes.c_char_p * len(parameters))(*(text.encode() for text in parameters))
        options.parameter_count = len(parameters)
        self._call("create", options, ctypes.byref(self._handle))
        sizes = _Sizes()
        self._call("get_sizes", self._handle, sizes)
        self.task, self.num_envs = task, sizes.envs
        self.observation_size, self.action_size = sizes.observations, sizes.actions
        self.seconds_per_step = sizes.seconds_per_step
        self._seed = seed
        self._observations = _Floats(self.num_envs, self.observation_size)
        self._final = _Floats(self.num_envs, self.observation_size)
        self._actions = _Floats(self.num_envs, self.action_size)
        self._rewards = _Floats(self.num_envs, 1)
        self._terminated = (ctypes.c_uint8 * self.num_envs)()
        self._truncated = (ctypes.c_uint8 * self.num_envs)()

    def _call(self, name, *arguments):
        if getattr(self._library, "nonet_env_" + name)(*arguments) != 0:
            raise Error(self._library.nonet_env_last_error().decode(errors="replace"))

    def reset(self, seed=None):
        """Observations and an empty dictionary. All environments begin the first episodes of `seed`; without one, of
        that given to the constructor, and of the number after it from the second time on."""
        if self._handle.value is None:
            raise Error("this batch is closed")
        if seed is None:
            seed = self._seed
        seed = _seed(seed)
        self._seed = (seed + 1) % 2 ** 64
        self._call("reset", self._handle, seed, self._observations.values, self._observations.count)
        return self._observations.get(), {}

    def step(self, actions):
        """Observations, rewards, terminated, truncated (the episode ended only because its time was up), info."""
        if self._handle.value is None:
            raise Error("this batch is closed")
        self._actions.put(actions)
        self._call("step", self._handle, self._actions.values, self._actions.count, self._observations.values,
                   self._observations.count, self._rewards.values, self._terminated, self._truncated, self.num_envs)
        info = {}
        if any(self._terminated) or any(self._truncated):
            self._call("final_observations", self._handle, self._final.values, self._final.count)
            info["final_obs"] = self._final.get()
        return (self._observations.get(), self._rewards.vector(), _flags(self._terminated), _flags(self._truncated),
                info)

    def close(self):
        handle, self._handle = self._handle, ctypes.c_void_p()
        if handle.value is not None:
            self._library.nonet_env_destroy(handle)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __del__(self):
        if hasattr(self, "_handle") and hasattr(self, "_library"):
            self.close()


def _plain(values):
    return [_plain(value) if hasattr(value, "__len__") else float(value) for value in values]


class PipeEnv:
    """The same over standard input and output of `nonet env`, for those who cannot load a library, and to compare with:
    only what a step needs. Rows of numbers as in VectorEnv without numpy; an end is not told from time that is up."""

    def __init__(self, nonet, task, envs=1, seed=1, options=()):
        command = [nonet, "env", task, "--envs", str(envs), "--seed", str(seed), *options]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        line = self._process.stdout.readline()
        if not line:
            self.close()
            raise Error(f"{' '.join(command)}: no answer")
        header = json.loads(line)
        self.num_envs, self.seconds_per_step = header["envs"], header["seconds_per_step"]
        self.observation_size, self.action_size = header["observations"], header["actions"]
        self.first_observations = self._matrix(self.observation_size)

    def _read(self, size):
        data = self._process.stdout.read(size)
        if len(data) != size:
            raise Error("nonet env has ended")
        return data

    def _matrix(self, columns):
        flat = array.array("f", self._read(4 * self.num_envs * columns))
        return [flat[row * columns:(row + 1) * columns] for row in range(self.num_envs)]

    def step(self, actions):
        """Observations, rewards, ends."""
        self._process.stdin.write(array.array("f", [number for row in actions for number in row]).tobytes())
        self._process.stdin.flush()
        return self._matrix(self.observation_size), [row[0] for row in self._matrix(1)], self._read(self.num_envs)

    def processor_time(self):
        """s, of the program alone."""
        fields = pathlib.Path(f"/proc/{self._process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def close(self):
        self._process.stdin.close()
        self._process.stdout.close()
        self._process.wait()


def _random_actions(env):
    draw = random.Random(1)
    return [[[draw.uniform(-0.3, 0.3) for _ in range(env.action_size)] for _ in range(env.num_envs)]
            for _ in range(64)]


class _Meter:
    """Steps a second of processor time, and of the clock on the wall."""

    def __init__(self, env, processor_time):
        self.env, self.processor_time = env, processor_time
        self.batches, self.used, self.waited = 0, 0.0, 0.0

    def run(self, actions, seconds):
        begin, wall = self.processor_time(), time.perf_counter()
        while (used := self.processor_time() - begin) < seconds:
            for _ in range(8):
                self.env.step(actions[self.batches % len(actions)])
                self.batches += 1
        self.used += used
        self.waited += time.perf_counter() - wall

    def report(self, name):
        rate = self.batches * self.env.num_envs / self.used
        clock = self.batches * self.env.num_envs / self.waited
        print(f"{name:<8} {rate:.0f} steps a second of one core, {rate * self.env.seconds_per_step:.0f} times real "
              f"time; {clock:.0f} a second of the clock")


def bench(arguments):
    """The library, and with --pipe `nonet env` in turn with it: the same actions, a second each."""
    options = ["--type", str(arguments.type), "--threads", str(arguments.threads)] + ["--quick"] * arguments.quick
    env = VectorEnv(arguments.task, arguments.envs, threads=arguments.threads, robot_type=arguments.type,
                    quick=arguments.quick)
    actions = _random_actions(env)
    own = [numpy.array(matrix, dtype=numpy.float32) for matrix in actions] if numpy is not None else actions
    meters = {"library": (_Meter(env, time.process_time), own)}
    shown = _plain(env.reset()[0])
    if arguments.pipe:
        pipe = PipeEnv(arguments.pipe, arguments.task, arguments.envs, options=options)
        if _plain(pipe.first_observations) != shown:
            raise Error("library and pipe do not begin with the same numbers")
        meters["pipe"] = (_Meter(pipe, lambda: time.process_time() + pipe.processor_time()), actions)
    left = arguments.bench
    while left > 0:
        for meter, taken in meters.values():
            meter.run(taken, min(1.0, left))
        left -= 1.0
    for name, (meter, _) in meters.items():
        meter.report(name)
        meter.env.close()


def _test_without_library():
    here = pathlib.Path("/a/share/nonet/scripts")
    assert library_candidates(here, {"NONET_ENV_LIBRARY": "/x.so"}) == ["/x.so"]
    assert library_candidates(here, {})[-1] == NAME
    floats = _Floats(2, 3)
    for matrix in ([[1, 2, 3], [4, 5, 6]], [1, 2, 3, 4, 5, 6], array.array("f", range(1, 7))):
        floats.put(matrix)
        assert list(floats.values) == [1, 2, 3, 4, 5, 6]
    assert [list(row) for row in floats.get()] == [[1, 2, 3], [4, 5, 6]]
    wrongs = [[1, 2], [[1, 2, 3]], [], [[1, 2, 3], [4, 5]], [[1, 2], [3, 4], [5, 6]], [[1, 2, 3, 4], [5, 6]]]
    if numpy is not None:
        floats.put(numpy.array([[1, 2, 3], [4, 5, 6]]))
        wrongs += [numpy.ones((3, 2)), numpy.ones((1, 6)), numpy.ones(5)]
    for wrong in wrongs:
        try:
            floats.put(wrong)
        except ValueError as trouble:
            assert "2 x 3 needed" in str(trouble)
        else:
            raise AssertionError(f"{wrong} was taken")
    assert (_int32("envs", 3), _int32("envs", -1), _seed(2 ** 64 - 1)) == (3, -1, 2 ** 64 - 1)
    for check in (lambda: _int32("envs", 2 ** 32 + 1), lambda: _seed(-1), lambda: _seed(2 ** 64)):
        try:
            check()
        except Error as trouble:
            assert "must be" in str(trouble)
        else:
            raise AssertionError("a number was taken that ctypes cuts")
    try:
        load("/none/" + NAME)
    except Error as trouble:
        assert "NONET_ENV_LIBRARY" in str(trouble)
    else:
        raise AssertionError("a library that is not there was loaded")


def _test_library():
    assert {"run", "dribble", "receive"} <= set(tasks())
    for wrong, word in (({"task": "fly"}, "dribble"), ({"envs": 0}, "envs"), ({"data_folder": "/none"}, "/none"),
                        ({"parameters": ["no.such=1"]}, "no.such"), ({"envs": 2 ** 32 + 1}, "envs"),
                        ({"seed": -1}, "seed")):
        try:
            VectorEnv(**{"task": "run", **wrong})
        except Error as trouble:
            assert word in str(trouble), trouble
        else:
            raise AssertionError(f"{wrong} was taken")
    with VectorEnv("run", envs=3, seed=5, quick=True) as env:
        draw = random.Random(1)
        actions = [[[draw.uniform(-1, 1) for _ in range(env.action_size)] for _ in range(3)] for _ in range(80)]
        runs, ended = [], 0
        for seed in (None, 5, 6):  # the first is the constructor's, 5
            seen = [_plain(env.reset(seed)[0])]
            for action in actions:
                observations, rewards, terminated, truncated, info = env.step(action)
                seen.append([_plain(observations), _plain(rewards), _plain(terminated)])
                assert ("final_obs" in info) == (any(terminated) or any(truncated))
                for i in range(3):
                    assert not (terminated[i] and truncated[i])
                    if terminated[i]:
                        ended += 1
                        assert rewards[i] < -0.5 and list(info["final_obs"][i]) != list(observations[i])
            runs.append(seen)
        assert runs[0] == runs[1] != runs[2]
        assert ended > 0, "nobody fell"
        try:
            env.step([0.0])
        except ValueError:
            pass
        else:
            raise AssertionError("too few actions were taken")
        try:
            env.step([float("nan")] * 3 * env.action_size)
        except Error as trouble:
            assert "not a number" in str(trouble)
        else:
            raise AssertionError("NaN was taken")
    try:
        env.step(actions[0])
    except Error as trouble:
        assert "closed" in str(trouble)
    else:
        raise AssertionError("a closed batch stepped")


def self_test():
    _test_without_library()
    try:
        load()
    except Error as trouble:
        if os.environ.get("NONET_ENV_LIBRARY"):
            raise
        print(f"nonet_env: its own code is right; the library is not tested ({trouble})")
        return
    _test_library()
    print(f"nonet_env: the library does what it should, {'with' if numpy is not None else 'without'} numpy")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", nargs="?")
    parser.add_argument("--list", action="store_true", help="the tasks")
    parser.add_argument("--bench", type=float, metavar="SECONDS", help="steps a second of one core")
    parser.add_argument("--pipe", metavar="NONET", help="compare with this program's `nonet env`")
    parser.add_argument("--envs", type=int, default=4)
    parser.add_argument("--threads", type=int, default=1)
    parser.add_argument("--type", type=int, default=0, help="robot type")
    parser.add_argument("--quick", action="store_true", help="quick stepper instead of the exact one")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    if arguments.self_test:
        return self_test()
    if arguments.list:
        for name, description in tasks().items():
            print(f"{name:<10} {description}")
    elif arguments.task and arguments.bench:
        bench(arguments)
    else:
        parser.error("give --list, --self-test, or a task and --bench")


if __name__ == "__main__":
    try:
        main()
    except Error as problem:
        sys.exit(f"nonet_env: {problem}")
