#!/usr/bin/env python3
"""Runs a campaign on a Ray cluster. Each shard is a task. A task that is stopped (exit 75) or lost continues elsewhere.

    pip install ray
    python docs/cluster/ray_campaign.py duck_beta --out /shared/beta --shards 64 --cpus 2

DIR must be a folder that all nodes see. The program must have the same version on each node.
"""

import argparse
import os
import subprocess
import sys

import ray

FINAL = (0, 1, 2)  # done, error, usage; after any other code (75: stopped, or killed) the shard is tried again


def shard(command: list[str], i: int, n: int, cpus: int) -> int:
    """Does one shard. Runs that are done are not repeated, so a lost task can simply be started again."""
    share = ["--shard", f"{i}/{n}", "--jobs", str(cpus), "--quiet"]
    code = subprocess.run(command + share).returncode
    if code not in FINAL:
        raise RuntimeError(f"shard {i}/{n} stopped with {code}")
    return code


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaign", help="campaign file, or the name of one that comes with the program")
    parser.add_argument("--out", required=True, help="folder for the blocks")
    parser.add_argument("--shards", type=int, required=True, help="number of tasks")
    parser.add_argument("--cpus", type=int, default=1, help="cores a task takes")
    parser.add_argument("--block", type=int, help="runs in a block; without it by what they cost")
    parser.add_argument("--program", default="rheotaxis")
    parser.add_argument("--address", help="of the cluster; without it RAY_ADDRESS, or this machine alone")
    args = parser.parse_args()

    file = os.path.abspath(args.campaign) if os.path.exists(args.campaign) else args.campaign
    command = [args.program, "campaign", "run", file]
    command += ["--out", os.path.abspath(args.out)]
    if args.block:
        command += ["--block", str(args.block)]

    ray.init(address=args.address, log_to_driver=True)
    task = ray.remote(num_cpus=args.cpus, max_retries=5, retry_exceptions=True)(shard)
    running = {task.remote(command, i, args.shards, args.cpus): i for i in range(1, args.shards + 1)}
    failed = []
    while running:
        (done,), _ = ray.wait(list(running), num_returns=1)
        i = running.pop(done)
        try:
            code = ray.get(done)
        except ray.exceptions.RayError as error:
            code = str(error).strip().splitlines()[-1]
        if code != 0:
            failed.append(i)
        print(f"shard {i}/{args.shards}: exit {code}; {len(running)} to go", flush=True)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
