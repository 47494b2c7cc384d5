"""A local cluster of three `robot-query worker` processes against one process: cluster.py ROBOT-QUERY [ROWS].

The estimates and residuals must be those of one process. Then a worker is killed in the middle of a query, at several
moments: the answer must be the same, or there must be none, with an error that says that a worker was lost.
"""

import csv
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROBOT = Path(__file__).parents[2] / "robots" / "ur5.toml"


class Cluster:
    """Three workers on free ports of this machine."""

    def __init__(self, command: str) -> None:
        start = [command, "worker", "--listen", "127.0.0.1:0"]
        self.processes = [subprocess.Popen(start, stdout=subprocess.PIPE, text=True) for _ in range(3)]
        self.addresses = ",".join(process.stdout.readline().strip() for process in self.processes)

    def __enter__(self) -> "Cluster":
        return self

    def __exit__(self, *_: object) -> None:
        for process in self.processes:
            process.kill()
            process.wait()


def estimates(path: Path) -> list[float]:
    with open(path) as lines:
        return [float(line["value"]) for line in csv.DictReader(lines)]


def difference(found: list[float], wanted: list[float]) -> float:
    largest = max(map(abs, wanted))
    return max(abs(one - other) for one, other in zip(found, wanted, strict=True)) / largest


def main() -> None:
    command, rows = sys.argv[1], int(float(sys.argv[2])) if len(sys.argv) > 2 else 300_000
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        log, answer = folder / "log", folder / "answer.csv"
        # The files of the project are pinned, their texts are not: the same text, so the same operations.
        robot = folder / "ur5.toml"
        robot.write_text(ROBOT.read_text())
        make = [command, "generate", robot, "--rows", rows, "--files", 6, "--noise", 0.5, "-o", log]
        subprocess.run(list(map(str, make)), check=True, stderr=subprocess.DEVNULL)
        identify = ["identify", str(robot), str(log), "--noise", "1", "-o", str(answer)]

        def ask(*more: str) -> subprocess.Popen:
            answer.unlink(missing_ok=True)
            pipe = subprocess.PIPE
            return subprocess.Popen([command, *more, *identify], stdout=pipe, stderr=pipe, text=True)

        single = ask()
        text, complaints = single.communicate()
        assert single.returncode == 0, complaints
        wanted = estimates(answer)
        with Cluster(command) as cluster:
            plan = subprocess.run(
                [command, "--workers", cluster.addresses, *identify[:3], "--explain"], capture_output=True, text=True
            )
            assert "tasks=3" in plan.stdout, plan.stdout + plan.stderr
            start = time.perf_counter()
            query = ask("--workers", cluster.addresses)
            text, complaints = query.communicate()
            assert query.returncode == 0, complaints
            seconds = time.perf_counter() - start
            error = difference(estimates(answer), wanted)
            print(f"{rows} rows by three workers in {seconds:.1f} s: {error:.1e} from one process")
            assert error < 1e-12, error
        right, lost = 0, 0
        for part in (0.1, 0.3, 0.5, 0.7, 0.9):
            with Cluster(command) as cluster:
                query = ask("--workers", cluster.addresses)
                time.sleep(part * seconds)
                cluster.processes[1].kill()
                text, complaints = query.communicate()
                if query.returncode == 0:
                    right += 1
                    assert difference(estimates(answer), wanted) < 1e-12
                else:
                    lost += 1
                    assert "worker" in complaints and not answer.exists(), complaints
                    message = complaints.strip()
        print(f"one of three workers killed in the middle: {right} right answers, {lost} errors")
        assert lost > 0, "no worker was killed in the middle"
        print(message)


main()
