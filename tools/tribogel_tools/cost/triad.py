"""STREAM's triad of tests/benchmark/bench_kernels.cpp on several cores at once."""
import json
import subprocess

from ..command_line import BadInput
from ..program import built, install


def kernel_benchmarks():
    """Path of the program, built."""
    if not install("--benchmarks"):
        raise BadInput("Google Benchmark is missing (--no-triad does without)")
    return built("kernel_benchmarks", "-DTRIBOGEL_BENCHMARKS=ON")


def bytes_per_second(program, processes):
    """Of all processes together, started at once. They run for a second each, so that they overlap."""
    command = [str(program), "--benchmark_filter=^triad$", "--benchmark_format=json",
               "--benchmark_min_time=1"]
    started = [subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
               for _ in range(processes)]
    rates = []
    for process in started:
        text = process.communicate()[0]
        try:
            rates.append(float(json.loads(text)["benchmarks"][0]["B/s"]))
        except (ValueError, KeyError, IndexError) as error:
            raise BadInput(f"{program} measures no triad") from error
    return sum(rates)


def triad_rates(ranks, program=None):
    """Bytes a second on one core and on each number of processes."""
    program = program or kernel_benchmarks()
    one = bytes_per_second(program, 1)
    return {1: one} | {p: bytes_per_second(program, p) for p in ranks if p > 1}
