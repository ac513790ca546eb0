"""A client that speaks with isols or isodap through pipes, for benchmarks and the soak test; and the programs that benchmarks open."""

import json
import re
import subprocess
import sys
import threading
import time
from pathlib import Path

from compare import SEED, CannotMeasure

BUILD = Path(__file__).resolve().parent.parent / "build/release"


class Client:
    """A server and the messages that have come from it, each with the time at which it was there."""

    def __init__(self, program, **options):
        """`options` are those of Popen."""
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, bufsize=0, **options)
        self.messages = []
        self.changed = threading.Condition()
        self.has_ended = False
        threading.Thread(target=self.read_all, daemon=True).start()

    def read_all(self):
        data = bytearray()
        header = re.compile(rb"Content-Length: (\d+)\r\n\r\n")
        while True:
            match = header.match(data)
            if match and len(data) >= match.end() + int(match[1]):
                arrived = time.perf_counter()
                message = json.loads(data[match.end() : match.end() + int(match[1])])
                del data[: match.end() + int(match[1])]
                self.take(arrived, message)
                continue
            piece = self.process.stdout.read(1 << 20)
            if not piece:
                break
            data += piece
        with self.changed:
            self.has_ended = True
            self.changed.notify_all()

    def take(self, arrived, message):
        with self.changed:
            self.messages.append((arrived, message))
            self.changed.notify_all()

    def send_bytes(self, body):
        self.process.stdin.write(b"Content-Length: %d\r\n\r\n" % len(body))
        view = memoryview(body)
        while view:
            view = view[self.process.stdin.write(view) :]

    def send(self, message):
        self.send_bytes(json.dumps(message).encode())

    def anonymous_bytes(self):
        """The server's memory that is no file."""
        status = Path(f"/proc/{self.process.pid}/status").read_text(encoding="ascii")
        return int(re.search(r"RssAnon:\s+(\d+)", status)[1]) * 1024

    def wait(self, fits, seconds=120):
        """The next message that fits, and when it was there."""
        deadline = time.monotonic() + seconds
        with self.changed:
            while True:
                for i, (arrived, message) in enumerate(self.messages):
                    if fits(message):
                        del self.messages[i]
                        return arrived, message
                if self.has_ended:
                    raise CannotMeasure("the server has ended")
                if not self.changed.wait(deadline - time.monotonic()):
                    raise CannotMeasure("the server does not answer")


def corpus(build, kind, lines):
    """A program as isocnc_corpus makes it, bytes."""
    run = subprocess.run([build / "bench/isocnc_corpus", kind, str(lines), str(SEED)], capture_output=True, check=True)
    return run.stdout


def run(name, measure):
    """Ends with the exit status: 0 where `measure` says that every target was met, 1 where not, 2 after a complaint."""
    try:
        sys.exit(0 if measure() else 1)
    except (CannotMeasure, OSError, subprocess.SubprocessError) as problem:
        print(f"{name}: {problem}", file=sys.stderr)
        sys.exit(2)
