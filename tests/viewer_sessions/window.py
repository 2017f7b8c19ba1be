"""The viewer on a virtual display (Xvfb), used by real mouse and key events (xdotool)."""

import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import tempfile
import time
import zlib

VIEWER = os.environ.get("LAPWING_VIEWER", "lapwing-viewer")
PICTURES = pathlib.Path(os.environ.get("LAPWING_PICTURES", "viewer_sessions"))
WIDTH, HEIGHT = 1280, 800
#: A loaded machine may need this long for work of a few seconds.
PATIENCE_SECONDS = 60
#: A person moves the mouse in steps of about this time.
MOUSE_STEP = "0.03"


def wait_for(what, condition):
    """Returns the first true result of `condition`."""
    end = time.monotonic() + PATIENCE_SECONDS
    while not (result := condition()):
        assert time.monotonic() < end, f"this did not happen: {what}"
        time.sleep(0.05)
    return result


class Window:
    """A display with one viewer, whose home folder is new. `name` is that of the pictures."""

    def __init__(self, name):
        self.name = name
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="lapwing-session-"))
        self.pictures = 0
        number, written = os.pipe()
        self.display = subprocess.Popen(
            ["Xvfb", "-screen", "0", f"{WIDTH}x{HEIGHT}x24", "-noreset", "-nolisten", "tcp",
             "-fbdir", self.folder, "-displayfd", str(written)],
            pass_fds=[written], stderr=subprocess.DEVNULL)  # fmt: skip
        os.close(written)
        with os.fdopen(number) as digits:
            display = ":" + digits.readline().strip()
        home = self.folder / "home"
        home.mkdir()
        self.environment = {
            **os.environ, "DISPLAY": display, "HOME": str(home),
            "XDG_CACHE_HOME": str(home / "cache"), "XDG_CONFIG_HOME": str(home / "config"),
            "XDG_DATA_HOME": str(home / "data"), "XDG_STATE_HOME": str(home / "state"),
        }  # fmt: skip
        for desktop in ("WAYLAND_DISPLAY", "XDG_CURRENT_DESKTOP"):
            self.environment.pop(desktop, None)
        self.viewer = None

    def start(self, *arguments):
        # Without programs in PATH the viewer shows its own file dialog.
        self.viewer = subprocess.Popen([VIEWER, *map(str, arguments)],
                                       env={**self.environment, "PATH": ""})  # fmt: skip
        name = pathlib.Path(arguments[0]).name if arguments else "Lapwing"
        wait_for(f"the window shows {name}", lambda: name in self.title())
        self.settle()

    def kill(self):
        self.viewer.send_signal(signal.SIGKILL)
        self.viewer.wait()

    def close(self):
        for process in (self.viewer, self.display):
            if process and process.poll() is None:
                process.terminate()
                process.wait()
        shutil.rmtree(self.folder)

    def title(self):
        return self.xdotool("search", "--onlyvisible", "--name", "Lapwing", "getwindowname").strip()

    def xdotool(self, *words):
        return subprocess.run(["xdotool", *words], env=self.environment, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout  # fmt: skip

    def keys(self, *names):
        for name in names:
            self.xdotool("key", name, "sleep", "0.1")

    def type(self, text):
        self.xdotool("type", "--delay", "8", str(text))

    def click(self, x, y):
        self.xdotool("mousemove", str(x), str(y), "sleep", "0.15", "click", "1", "sleep", "0.15")

    def drag(self, *points, held=None, release=True):
        """Presses the left button at the first point and moves the mouse along the others."""
        words = ["mousemove", *map(str, points[0]), "sleep", "0.15"]
        words += ["keydown", held] if held else []
        words += ["mousedown", "1", "sleep", "0.15"]
        for (x0, y0), (x1, y1) in zip(points, points[1:]):
            for k in range(1, 9):
                words += ["mousemove", str(x0 + (x1 - x0) * k // 8), str(y0 + (y1 - y0) * k // 8)]
                words += ["sleep", MOUSE_STEP]
        words += ["mouseup", "1"] if release else []
        words += ["keyup", held] if held else []
        self.xdotool(*words)

    def screen(self):
        """The width, the height and the RGB bytes of the picture on the display."""
        dump = (self.folder / "Xvfb_screen0").read_bytes()
        header = struct.unpack(">25I", dump[:100])
        width, height, row = header[4], header[5], header[12]
        start = header[0] + 12 * header[19]
        rgb = bytearray(3 * width * height)
        pixels = b"".join(dump[start + y * row : start + y * row + 4 * width] for y in range(height))
        for channel in range(3):
            rgb[channel::3] = pixels[2 - channel :: 4]
        return width, height, bytes(rgb)

    def settle(self):
        """Waits until the picture stays the same for a moment."""
        last = [None]

        def same():
            time.sleep(0.3)
            now = self.screen()
            last[0], before = now, last[0]
            return now == before

        wait_for("the picture stays the same", same)

    def keep_picture(self, what):
        """Writes the picture as a PNG file, for people to look at."""
        self.pictures += 1
        width, height, rgb = self.screen()
        rows = b"".join(b"\0" + rgb[3 * width * y : 3 * width * (y + 1)] for y in range(height))

        def chunk(kind, data):
            return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

        PICTURES.mkdir(parents=True, exist_ok=True)
        (PICTURES / f"{self.name}-{self.pictures}-{what}.png").write_bytes(
            b"\x89PNG\r\n\x1a\n"
            + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows, 1))
            + chunk(b"IEND", b"")
        )

    def save(self, keys, path):
        """Saves a file by the viewer's dialog."""
        self.keys(keys)
        self.settle()
        self.type(path)
        self.keys("Return")
        wait_for(f"{path.name} is written", path.exists)
        self.settle()

    def journals(self):
        return list((self.folder / "home/cache/lapwing").glob("*.journal"))

    def draft(self):
        """The edit in the journal: its committed steps, the open step and whether it has settled."""
        steps, last = [], None
        for journal in self.journals():
            for line in map(json.loads, journal.read_text().splitlines()):
                if "keep" in line:
                    steps = steps[: line["keep"]] + line["add"]
                    last = line
        return steps, last

    def wait_for_steps(self, count):
        """Waits until the recipe would have `count` steps."""

        def done():
            steps, last = self.draft()
            return last and len(steps) + last["settled"] == count

        wait_for(f"the edit has {count} steps, but it has {self.draft()}", done)
        self.settle()
