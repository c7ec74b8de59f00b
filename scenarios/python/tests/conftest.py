"""What the tests share. Spin-ups are made here, and the user's own stay as they are."""

import os

import pytest

os.environ["RHEOTAXIS_NO_CACHE"] = "1"

import rheotaxis  # noqa: E402


@pytest.fixture
def channel():
    """A channel with a short spin-up and a minute of mission."""
    channel = rheotaxis.Scenario.load("uniform_channel")
    return channel.with_({"time.spin_up_s": 300, "time.limit_s": 60})


@pytest.fixture
def endless():
    """A run that takes minutes of wall clock."""
    channel = rheotaxis.Scenario.load("uniform_channel")
    return channel.with_({"time.spin_up_s": 0, "time.limit_s": 1e6, "robots": [], "success": rheotaxis.Ron("Completed")})
