"""What a script has checked, and how it closes."""


class Results:
    """What held and what did not."""

    def __init__(self):
        self.passed = self.failed = 0

    def check(self, what, holds, found=""):
        self.passed, self.failed = self.passed + bool(holds), self.failed + (not holds)
        print(("ok    " if holds else "FAILED"), what, "" if holds else f": {found}", flush=True)

    def close(self):
        """The last line, and the exit code."""
        print(f"{self.passed} passed, {self.failed} failed")
        return 1 if self.failed else 0
