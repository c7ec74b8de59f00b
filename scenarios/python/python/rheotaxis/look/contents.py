"""What a recording holds, found without reading its messages, also of one that breaks off.

*Source*: MCAP specification, version 0 (records, chunks, summary).
"""

from dataclasses import dataclass, field
from pathlib import Path

from mcap.exceptions import McapError
from mcap.records import Attachment, Channel, Chunk, DataEnd, Footer, Message, Metadata
from mcap.stream_reader import StreamReader, breakup_chunk

from .errors import LookError

#: What reading a damaged file can raise, next to the library's own errors.
BROKEN = (McapError, EOFError, ValueError, IndexError, OverflowError, RuntimeError)


@dataclass
class Contents:
    """What a recording says before its messages are read."""

    path: Path
    whole: bool = True
    first_s: float | None = None
    last_s: float | None = None
    topics: set = field(default_factory=set)
    scene: bytes | None = None
    run: dict = field(default_factory=dict)

    @property
    def duration_s(self):
        """Length of what can be read, s."""
        return max(0.0, (self.last_s or 0.0) - (self.first_s or 0.0))

    def name(self):
        """Name of the run, as its live state has it."""
        return f"{self.run.get('scenario', self.path.stem)}_{self.run.get('seed', '')}".rstrip("_")

    def machines(self):
        """Ids of the machines with topics of their own."""
        kinds = ("truth", "joint_states")
        return sorted({t.split("/")[1] for t in self.topics if t.count("/") == 2 and t.endswith(kinds)})

    def has(self, ending):
        """Whether some machine has a topic that ends so."""
        return any(t.endswith(ending) for t in self.topics)


def find(where):
    """The recording that a user means: an `.mcap`, or a folder with `run.mcap` in it."""
    path = Path(where)
    if path.is_dir():
        inside = path / "run.mcap"
        if not inside.is_file():
            others = sorted(path.glob("*.mcap*"))
            hint = f" It holds {others[0].name}: name that file." if others else " Was it written with --no-record?"
            raise LookError(f"{path}: no run.mcap in this folder.{hint}")
        return inside
    if not path.is_file():
        raise LookError(
            f"{path}: there is no such file or folder. Name a folder such as runs/duck_st-1, or its run.mcap."
        )
    return path


def look_into(path):
    """The contents of a recording."""
    contents = Contents(path)
    ended = False
    try:
        with open(path, "rb") as file:
            for record in StreamReader(file, emit_chunks=True).records:
                if isinstance(record, Chunk):
                    _chunk(contents, record)
                elif isinstance(record, Channel):
                    contents.topics.add(record.topic)
                elif isinstance(record, Message):
                    _times(contents, record.log_time, record.log_time)
                elif isinstance(record, Attachment) and record.name == "scene.json":
                    contents.scene = record.data
                elif isinstance(record, Metadata) and record.name == "run":
                    contents.run = dict(record.metadata)
                elif isinstance(record, (DataEnd, Footer)):
                    ended = True
    except OSError as e:
        raise LookError(f"{path}: cannot be read ({e.strerror}).") from e
    except BROKEN as e:
        if contents.last_s is None:
            raise LookError(
                f"{path}: this is no MCAP recording, or it is cut off before its first messages ({e})."
            ) from e
        ended = False
    contents.whole = ended
    if not contents.topics:
        raise LookError(f"{path}: the recording holds no messages.")
    return contents


def _chunk(contents, chunk):
    before = len(contents.topics)
    # Channels stand in the chunk in which they first come and, of a whole file, again at its end.
    for record in breakup_chunk(chunk, validate_crc=True):
        if isinstance(record, Channel):
            contents.topics.add(record.topic)
    if chunk.message_end_time or before == 0:
        _times(contents, chunk.message_start_time, chunk.message_end_time)


def _times(contents, first_ns, last_ns):
    first, last = 1e-9 * first_ns, 1e-9 * last_ns
    contents.first_s = first if contents.first_s is None else min(first, contents.first_s)
    contents.last_s = last if contents.last_s is None else max(last, contents.last_s)
