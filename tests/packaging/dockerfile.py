"""Reads the Dockerfile as plainly as it is written: stages, and their steps in order."""

import json
import re
import shlex


class Stage:
    """One FROM and what follows it."""

    def __init__(self, base, name):
        self.base, self.name, self.steps = base, name, []

    def of(self, kind):
        return [step for found, step in self.steps if found == kind]

    def last(self, kind):
        return self.of(kind)[-1]


def read(path):
    """The stages of a Dockerfile, by name; the last is also under None."""
    text = re.sub(r"\\\n", " ", path.read_text(encoding="utf-8"))
    stages = {}
    for line in text.splitlines():
        line = line.strip()
        if not line or line.startswith("#"):
            continue
        kind, rest = line.split(None, 1)
        if kind == "FROM":
            words = rest.split()
            stage = Stage(words[0], words[2] if len(words) == 3 else None)
            stages[stage.name] = stages[None] = stage
        else:
            stage.steps.append((kind, rest))
    return stages


def copy(step):
    """Options, sources and target of a COPY."""
    words = shlex.split(step)
    options = dict(word[2:].split("=", 1) for word in words if word.startswith("--"))
    paths = [word for word in words if not word.startswith("--")]
    return options, paths[:-1], paths[-1]


def run(step):
    """The folders whose content is kept from build to build, and the commands of a RUN."""
    mounts, words = re.findall(r"--mount=(\S+)", step), re.sub(r"--mount=\S+\s+", "", step)
    caches = [dict(part.split("=", 1) for part in mount.split(","))["target"] for mount in mounts]
    return caches, words.split(" && ")


def environment(stage):
    """What ENV sets."""
    return dict(word.split("=", 1) for step in stage.of("ENV") for word in shlex.split(step))


def words(step):
    """An exec form: a list in JSON."""
    return json.loads(step)


def healthcheck(stage):
    """The words of the health check's command."""
    return words(stage.last("HEALTHCHECK").split(" CMD ", 1)[1])
