"""Logs in a bucket against the same logs on disk: object_store.py ROBOT-QUERY [ROWS].

A server that speaks the protocol of S3 runs on this machine (moto). Queries, estimates and torques over s3:// must be those over the files, by one process and
by two workers; a bucket that is not there and an object that is not whole are said.
"""

import logging
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import boto3
import pyarrow.parquet as pq
from moto.server import ThreadedMotoServer

ROBOT = Path(__file__).parents[2] / "robots" / "ur5.toml"


def run(command: str, *arguments: object, fails: bool = False) -> str:
    found = subprocess.run([command, *map(str, arguments)], capture_output=True, text=True)
    assert (found.returncode != 0) == fails, found.stdout + found.stderr
    return found.stderr if fails else found.stdout


def main() -> None:
    command, rows = sys.argv[1], int(float(sys.argv[2])) if len(sys.argv) > 2 else 100_000
    logging.getLogger("werkzeug").setLevel(logging.ERROR)
    server = ThreadedMotoServer(port=0)
    server.start()
    host, port = server.get_host_and_port()
    # What users set, too.
    os.environ.update(
        AWS_ENDPOINT_URL=f"http://{host}:{port}",
        AWS_ALLOW_HTTP="true",
        AWS_ACCESS_KEY_ID="key",
        AWS_SECRET_ACCESS_KEY="secret",
        AWS_REGION="us-east-1",
    )
    bucket = boto3.client("s3", region_name="us-east-1")
    bucket.create_bucket(Bucket="logs")
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        log = folder / "log"
        run(command, "generate", ROBOT, "--rows", rows, "--files", 4, "--noise", 0.5, "-o", log)
        for file in sorted(log.iterdir()):
            bucket.upload_file(str(file), "logs", f"arm/{file.name}")
        query = "SELECT count(*) AS rows, max(t) AS t, sum(energies('{}', q, qd)['kinetic']) AS kinetic FROM '{}' WHERE episode < 5"
        local, remote = (run(command, "--threads", 1, "sql", query.format(ROBOT, place)) for place in (log, "s3://logs/arm/"))
        assert local == remote, local + remote
        print(remote.strip())
        workers = [
            subprocess.Popen([command, "worker", "--listen", "127.0.0.1:0"], stdout=subprocess.PIPE, text=True) for _ in range(2)
        ]
        try:
            addresses = ",".join(worker.stdout.readline().strip() for worker in workers)
            local = run(command, "identify", ROBOT, log, "--noise", 1)
            for more in ([], ["--workers", addresses]):
                remote = run(command, *more, "identify", ROBOT, "s3://logs/arm", "--noise", 1)
                assert local == remote, local + remote
        finally:
            for worker in workers:
                worker.kill()
                worker.wait()
        print(f"the same estimate of {rows} rows, by one process and by two workers")
        answers = [folder / "local.parquet", folder / "remote.parquet"]
        for place, answer in zip((log, "s3://logs/arm"), answers):
            run(command, "torques", ROBOT, place, "-o", answer, "--columns", "episode,t")
        local, remote = (pq.read_table(answer) for answer in answers)
        assert local.num_rows == rows and local == remote
        print("the same torques, row by row")
        print(run(command, "identify", ROBOT, "s3://gone/arm", fails=True).strip())
        whole = sorted(log.iterdir())[2].read_bytes()
        bucket.put_object(Bucket="logs", Key="arm/part-0002.parquet", Body=whole[: len(whole) // 2])
        print(run(command, "identify", ROBOT, "s3://logs/arm", fails=True).strip())
        print(run(command, "check", ROBOT, "s3://logs/arm", fails=True).strip())
    server.stop()


main()
