"""A queue in which newest values replace older ones, between what tells of a run and what draws it.

Telling never waits: values of one slot replace each other, and events that must all arrive wait in a bounded list.
"""

import threading
from collections import deque

#: Most events that wait without being replaced; beyond these the oldest are dropped.
MOST = 10_000


class Mailbox:
    """Filled from one side at any pace, emptied from the other."""

    def __init__(self):
        self._newest = {}
        self._kept = deque(maxlen=MOST)
        self._there = threading.Condition()
        self._closed = False
        self.superseded = 0

    def put(self, event):
        """Adds an event."""
        slot = event.slot()
        with self._there:
            if slot is None:
                self.superseded += len(self._kept) == MOST
                self._kept.append(event)
            else:
                self.superseded += self._newest.pop(slot, None) is not None
                self._newest[slot] = event
            self._there.notify()

    def take(self, patience_s):
        """All that is there, oldest first, after waiting for something; None once closed and empty."""
        with self._there:
            if not (self._newest or self._kept or self._closed):
                self._there.wait(patience_s)
            if not (self._newest or self._kept):
                return None if self._closed else []
            taken = [*self._kept, *self._newest.values()]
            self._kept.clear()
            self._newest.clear()
        return sorted(taken, key=lambda e: e.t_s)

    def close(self):
        """Nothing more will come."""
        with self._there:
            self._closed = True
            self._there.notify()
