"""Ctrl-C, threads, and processes."""

import os
import signal
import threading
import time

import pytest

import rheotaxis


def test_ctrl_c_ends_a_run(endless, tmp_path):
    def interrupt():
        # Once it has written into its folder, the run looks for signals.
        while not any(tmp_path.iterdir()):
            time.sleep(0.001)
        os.kill(os.getpid(), signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        threading.Thread(target=interrupt).start()
        rheotaxis.run(endless, files=tmp_path)
    # The results until then are written.
    assert '"outcome": "interrupted"' in (tmp_path / "summary.json").read_text()
    assert (tmp_path / "run.mcap").stat().st_size > 0


def test_ctrl_c_ends_a_spin_up(endless):
    scenario = endless.with_({"time.spin_up_s": 1e6})
    with pytest.raises(KeyboardInterrupt):
        threading.Timer(0.7, os.kill, (os.getpid(), signal.SIGINT)).start()
        rheotaxis.run(scenario)


def test_a_panic_is_an_exception_and_the_next_run_goes_on(channel):
    from rheotaxis import _rheotaxis

    with pytest.raises(RuntimeError, match="rheotaxis: .*no bottom"):
        _rheotaxis._panic("no bottom")
    assert rheotaxis.run(channel.with_({"time.limit_s": 2}), seed=1).digest


def test_what_a_handler_raises_comes_out(endless):
    class Enough(Exception):
        pass

    def handler(*_):
        raise Enough

    before = signal.signal(signal.SIGUSR1, handler)
    try:
        with pytest.raises(Enough):
            threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGUSR1)).start()
            rheotaxis.run(endless)
    finally:
        signal.signal(signal.SIGUSR1, before)


def test_two_threads_at_once_get_their_own_runs(channel):
    alone = [rheotaxis.run(channel, seed).digest for seed in (1, 2)]
    together = [None, None]

    def work(n):
        together[n] = rheotaxis.run(channel, n + 1).digest

    threads = [threading.Thread(target=work, args=(n,)) for n in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert together == alone


def test_python_goes_on_during_a_run(channel):
    ended = threading.Event()

    def work():
        rheotaxis.run(channel.with_({"time.limit_s": 600}), threads=1)
        ended.set()

    thread = threading.Thread(target=work)
    thread.start()
    turns = 0
    while not ended.is_set():
        turns += 1
        time.sleep(0.001)
    thread.join()
    assert turns > 5, "the run kept the interpreter's lock"


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_run_in_a_forked_process(channel):
    expected = rheotaxis.run(channel).digest
    read, write = os.pipe()
    pid = os.fork()
    if pid == 0:
        digest = b""
        try:
            digest = rheotaxis.run(channel).digest.encode()
        finally:
            os.write(write, digest or b"failed")
            os._exit(0)
    os.close(write)
    with os.fdopen(read, "rb") as pipe:
        assert pipe.read().decode() == expected
    os.waitpid(pid, 0)


@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_a_forked_process_paints_as_the_first_has(channel, tmp_path):
    first, second = tmp_path / "first", tmp_path / "second"
    rheotaxis.run(channel, files=first, threads=1)
    pid = os.fork()
    if pid == 0:
        # One that waits for threads that did not come along is ended.
        signal.alarm(60)
        try:
            rheotaxis.run(channel, files=second, threads=1)
        finally:
            os._exit(0)
    os.waitpid(pid, 0)
    assert (first / "map.png").read_bytes() == (second / "map.png").read_bytes()
    assert (second / "report.html").exists()
