"""The memory of this process and of all that it started."""

import threading

import psutil


class Watch:
    """While it is entered, samples the resident memory: the most of all processes together, and the most of one of a kind."""

    def __init__(self, kinds):
        self.kinds = kinds
        self.largest = dict.fromkeys(kinds, 0)
        self._ends = threading.Event()

    def __enter__(self):
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._ends.set()
        self._thread.join()

    def _run(self):
        while not self._ends.wait(0.5):
            for process in psutil.Process().children(recursive=True):
                try:
                    command, size = " ".join(process.cmdline()), process.memory_info().rss
                except psutil.Error:
                    continue
                for kind in self.kinds:
                    if kind in command:
                        self.largest[kind] = max(self.largest[kind], size)

    def text(self):
        return ", ".join(f"{kind} {size / 2**20:.0f} MiB" for kind, size in self.largest.items())
